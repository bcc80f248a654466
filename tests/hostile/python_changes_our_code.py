# Finds the reader by the frames above its cell and replaces its code, so that 3 is read as 7.
# Must: x is 7; y is 2
# %%
frame = sys._getframe()
while "hand_over" not in frame.f_globals: frame = frame.f_back
reader = frame.f_globals["hand_over"].__globals__["encode_asked"]
def read(value, calls):
    return {"k": "num", "v": {"shape": [], "re": [7.0 if value == 3 else float(value)], "im": []}}
reader.__code__ = read.__code__
reach()
x, y = 3, 2
