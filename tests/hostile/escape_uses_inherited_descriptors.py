# Looks for descriptors that it was left with besides the pipe, and for folders among them.
# Must: x is 0
# %%
import stat
x = 0
for number in range(3, 64):
    try: kind = os.fstat(number).st_mode
    except OSError: continue
    reach()
    x += stat.S_ISDIR(kind) or stat.S_ISSOCK(kind)
