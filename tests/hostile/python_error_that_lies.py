# Stops with an error whose text loops, whose class has no name, and which forges a verdict.
# Must: x lost; y is 2
# %%
class Liar(Exception):
    def __str__(self):
        while True: pass
Liar.__name__ = "\x1b[2J" * 100
x = 0
del x
# %%
raise Liar
x = 1
# %%
y = 2
