# Measures the kernel by perf_event_open.
# Must: process ended
# %%
call("perf_event_open", 0, 0, -1, -1, 0)
