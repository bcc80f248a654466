# Waits for somebody to type, by input and from the descriptor.
# Must: x lost; y is ''
# %%
y = sys.stdin.readline() + os.read(0, 10).decode()
# %%
x = input("the password, please: ")
