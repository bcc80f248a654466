# A function that never comes back from its second call.
# Must: y is 1
# %%
def f(a):
    while a > 1: pass
    return a
y = 1
