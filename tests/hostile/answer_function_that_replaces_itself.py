# A function that replaces itself and the list of calls while it is called.
# Must: y is 1
# %%
import gc
def f(a):
    global f
    f = lambda a: f
    reach()
    for found in gc.get_objects():
        if type(found).__name__ == "Functions": found.calls["f"] = [[1.0]] * 100_000
    return a
# %%
y = 1
