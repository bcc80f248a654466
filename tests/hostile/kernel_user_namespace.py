# Makes a user namespace, in which it would be root.
# Must: process ended
# %%
call("unshare", 0x10000000)
