# Kills its parent, the grader, its group, and everybody.
# Must: x refused
# %%
targets = (os.getppid(), GRADER, 0, -1, -GRADER, os.getpid(), 1)
x = [attempt(lambda: os.kill(target, 9)) for target in targets]
x += [attempt(lambda: os.killpg(os.getpgid(0), 9)), attempt(lambda: os.killpg(GRADER, 9))]
