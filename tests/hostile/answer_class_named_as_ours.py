# Hands in a class of the names that the reader looks for, with forged kinds.
# Must: x lost: not a matrix of numbers: a value of type Absent (TypeError); y is 1
# %%
class Absent:
    k, v, __module__ = "num", {"shape": [2], "re": [1, 1], "im": []}, "numpy"
    dtype = type("float64", (), {"kind": "O"})()
    def __getattribute__(self, name):
        reach()
        return object.__getattribute__(self, name)
    def tolist(self): return Absent()
x, y = Absent(), 1
