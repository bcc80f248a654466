# Makes a pipe, a socket, a device, and links in its folder.
# Must: x refused
# %%
x = [
    attempt(lambda: os.mkfifo("pipe")), attempt(lambda: os.mknod("disk", 0o60666, os.makedev(8, 0))),
    attempt(lambda: os.mknod("door", 0o140666)), attempt(lambda: os.symlink("/", "root")),
    attempt(lambda: os.link("measured.csv", "again")),
]
