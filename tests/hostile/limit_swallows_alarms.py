# Catches whatever would stop it, again and again.
# Must: x stopped
# Seconds: 3
# %%
while True:
    try:
        while True: pass
    except BaseException: pass
x = 1
