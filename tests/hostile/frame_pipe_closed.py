# Closes every descriptor, so that no answer can be handed over.
# Must: x lost
# %%
os.closerange(0, 64)
while True:
    try:
        while True: pass
    except BaseException: pass
x = 1
