# Starts processes by multiprocessing, in each way, and by concurrent.futures.
# Must: x refused
# %%
import multiprocessing, concurrent.futures
x = [attempt(lambda: multiprocessing.get_context(way).Process(target=print).start()) for way in ("fork", "spawn", "forkserver")]
x.append(attempt(lambda: concurrent.futures.ProcessPoolExecutor(1).submit(print).result()))
