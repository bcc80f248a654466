# Makes an io_uring, by which other calls go past a filter.
# Must: process ended
# %%
call("io_uring_setup", 8, ctypes.create_string_buffer(120))
