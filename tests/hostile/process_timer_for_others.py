# Makes a timer that signals another process, and asynchronous input that does.
# Must: x refused
# %%
event = (ctypes.c_int * 16)(0, 0, 9, 4, GRADER)
timer = ctypes.c_void_p()
x = [attempt(lambda: call("timer_create", 0, event, ctypes.byref(timer))), attempt(lambda: call("mq_notify", 0, event))]
