# Stops with an error whose text loops, whose class has no name, and which forges a verdict.
# Must: x lost: cell 3 stopped with an error; y is 2
# %%
class Liar(Exception):
    def __str__(self):
        while True: pass
Liar.__name__ = "\x1b[2J" * 100
x = 0
del x
# %%
reach()
raise Liar
x = 1
# %%
y = 2
