# Replaces the dict of variables by one that answers with what is asked for.
# Must: x lost: not a matrix of numbers: a value of type Giver (TypeError); y is 1
# %%
class Giver(dict):
    def __missing__(self, name): return 1
    def __contains__(self, name): return True
globals().update(Giver())
y = 1
reach()
x = Giver()
