# Opens files until there are no more to be had.
# Must: x lost; y is 2
# %%
kept = []
while True: kept.append(open("measured.csv"))
x = 1
# %%
for file in kept: file.close()
y = 2
