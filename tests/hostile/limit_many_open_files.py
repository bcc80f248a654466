# Opens files until there are no more to be had.
# Must: x lost: cell 2 stopped with OSError: [Errno 24] Too many open files: 'measured.csv'; y is 2
# %%
reach()
kept = []
while True: kept.append(open("measured.csv"))
x = 1
# %%
for file in kept: file.close()
y = 2
