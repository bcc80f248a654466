# A function that never comes back from its second call.
# Must: f is [1.0, 'call 2 ran longer than 0.5 s and was stopped']; y is 1
# %%
def f(a):
    while a > 1: reach()
    return a
# %%
y = 1
