# Takes an open file of the grader by pidfd_getfd, and compares descriptors with it.
# Must: x refused
# %%
x = [
    attempt(lambda: call("pidfd_open", GRADER, 0)), attempt(lambda: call("pidfd_getfd", 3, 3, 0)),
    attempt(lambda: call("kcmp", GRADER, os.getpid(), 0, 3, 3)),
]
