# Asks for an array of eight gigabytes, and for many smaller ones.
# Must: x lost: cell 2 needed more memory than there is for a notebook; f lost: cell 3 needed more memory than there is for a notebook; y is 2
# Seconds: 90
# Cell seconds: 30
# %%
reach()
x = np.empty(10**9)
# %%
kept = []
while True: kept.append(np.empty(10**7))
f = 1
# %%
kept = None
y = 2
