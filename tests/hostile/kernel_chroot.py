# Changes its root, as old jails were left.
# Must: x refused
# %%
x = attempt(lambda: os.chroot("."))
