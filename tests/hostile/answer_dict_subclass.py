# Replaces the dict of variables by one that answers with what is asked for.
# Must: y is 1; x lost
# %%
class Giver(dict):
    def __missing__(self, name): return 1
    def __contains__(self, name): return True
globals().update(Giver())
y = 1
x = Giver()
