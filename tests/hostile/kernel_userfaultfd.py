# Handles its own page faults, as exploits do.
# Must: process ended
# %%
call("userfaultfd", 0)
