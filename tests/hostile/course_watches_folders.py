# Watches the course by inotify and fanotify.
# Must: x refused
# %%
x = [attempt(lambda: call("inotify_init1", 0)), attempt(lambda: call("fanotify_init", 0, 0))]
