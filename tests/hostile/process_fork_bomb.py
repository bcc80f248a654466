# Forks for ever.
# Must: x lost; y is 2
# %%
while True: os.fork()
x = 1
# %%
y = 2
