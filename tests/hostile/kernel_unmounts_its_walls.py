# Unmounts what hides folders from it.
# Must: process ended
# %%
call("umount2", b"/packages", 2)
