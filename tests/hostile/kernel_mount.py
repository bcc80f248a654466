# Mounts the machine's processes over its own folder.
# Must: process ended
# %%
call("mount", b"proc", os.getcwd().encode(), b"proc", 0, 0)
