# Raises the limits of memory, processor, files and processes.
# Must: x refused: ValueError
# %%
import resource as r
x = []
for what in (r.RLIMIT_AS, r.RLIMIT_CPU, r.RLIMIT_FSIZE, r.RLIMIT_NOFILE, r.RLIMIT_CORE):
    x.append(attempt(lambda: r.setrlimit(what, (r.RLIM_INFINITY, r.RLIM_INFINITY))))
    x.append(attempt(lambda: r.prlimit(os.getppid(), what, (1, 1))))
