# Closes every descriptor, so that no answer can be handed over.
# Must: x lost: a cell closed the pipe that answers take
# Seconds: 60
# %%
reach()
# %%
os.closerange(0, 64)
while True:
    try:
        while True: sum(range(10_000))
    except BaseException: pass
x = 1
