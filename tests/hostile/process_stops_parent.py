# Stops its parent and the grader by SIGSTOP, so that they wait for ever.
# Must: x refused
# %%
x = [attempt(lambda: os.kill(target, 19)) for target in (os.getppid(), GRADER)]
