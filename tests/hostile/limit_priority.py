# Takes the processor before all others, and binds itself to one.
# Must: x refused
# %%
x = [
    attempt(lambda: os.nice(-20)), attempt(lambda: os.sched_setaffinity(os.getppid(), {0})),
    attempt(lambda: os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(50))),
    attempt(lambda: os.setpriority(os.PRIO_PGRP, 0, -20)),
]
