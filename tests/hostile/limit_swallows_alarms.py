# Catches whatever would stop it, again and again.
# Must: x lost: the notebook was stopped after 3 s
# Seconds: 3
# %%
reach()
# %%
while True:
    try:
        while True: sum(range(10_000))
    except BaseException: pass
x = 1
