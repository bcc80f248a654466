# Hands in an object whose pickle starts a program in whoever unpickles it.
# Must: x lost: not a matrix of numbers: a value of type Bomb (TypeError); y is 1
# %%
class Bomb:
    def __reduce__(self):
        return os.system, (f"touch /tmp/{MARK} {COURSE}/{MARK}",)
    def __reduce_ex__(self, _): return self.__reduce__()
    def __getstate__(self): return self.__reduce__()
reach()
x, y = Bomb(), 1
