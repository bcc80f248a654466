# Opens terminals, disks and the machine's memory.
# Must: x refused
# %%
names = ("tty", "mem", "kmem", "sda", "vda", "kvm", "fuse", "ptmx", "full", "net/tun", "loop0")
x = [attempt(lambda: open(f"/dev/{name}", "rb")) for name in names]
