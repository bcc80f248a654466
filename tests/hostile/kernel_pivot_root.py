# Changes its root to one that it knows.
# Must: process ended
# %%
call("pivot_root", b".", b".")
