# Has objects that loop when they are destroyed.
# Must: y is 2
# Seconds: 3
# %%
class Stay:
    def __del__(self):
        while True: pass
y = 2
# %%
reach()
kept = Stay()
del kept
