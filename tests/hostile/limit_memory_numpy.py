# Asks for an array of eight gigabytes, and for many smaller ones.
# Must: x lost; y is 2
# %%
kept = []
while True: kept.append(np.ones(10**7))
x = 1
# %%
kept = None
y = 2
