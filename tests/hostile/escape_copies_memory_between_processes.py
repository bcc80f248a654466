# Copies memory out of the grader by process_vm_readv.
# Must: process ended
# %%
buffer = ctypes.create_string_buffer(64)
there = (ctypes.c_uint64 * 2)(ctypes.addressof(buffer), 64)
LIBC.syscall(NUMBERS["process_vm_readv"][0 if INTEL else 1], GRADER, there, 1, there, 1, 0)
x = 1
