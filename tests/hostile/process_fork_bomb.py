# Forks for ever.
# Must: x lost: cell 2 stopped with PermissionError: [Errno 1] Operation not permitted; y is 2
# %%
reach()
while True: os.fork()
x = 1
# %%
y = 2
