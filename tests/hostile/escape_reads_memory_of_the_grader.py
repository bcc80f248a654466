# Reads the memory of the grader and of its own parent through /proc.
# Must: x refused
# %%
ids = (GRADER, os.getppid(), 1)
x = [attempt(lambda: open(f"/proc/{number}/mem", "rb").read(1)) for number in ids]
