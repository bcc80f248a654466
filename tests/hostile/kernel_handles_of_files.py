# Opens a file by its number on the disk, as if there were no folders.
# Must: process ended
# %%
handle = ctypes.create_string_buffer(136)
LIBC.open_by_handle_at(-100, handle, 0)
