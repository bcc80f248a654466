# Makes system calls by the numbers of another interface of the processor.
# Must: process ended
# %%
LIBC.syscall(ctypes.c_long(0x40000000 + 57))
x = 1
