# Reads environment, maps, root, descriptors and command of the grader, its parent and itself.
# Must: x refused
# %%
x = []
for number in (GRADER, os.getppid(), "self"):
    for name in ("environ", "maps", "cmdline", "status", "stat"):
        x.append(attempt(lambda: open(f"/proc/{number}/{name}").read()))
    x.append(attempt(lambda: os.listdir(f"/proc/{number}/fd")))
    x.append(attempt(lambda: os.listdir(f"/proc/{number}/root/")))
