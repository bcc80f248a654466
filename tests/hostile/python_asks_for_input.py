# Waits for somebody to type, by input and from the descriptor.
# Must: x lost: cell 3 stopped with RuntimeError: input() has nobody to ask when a sheet is marked; write the value into the cell; y is ''
# %%
y = sys.stdin.readline() + os.read(0, 10).decode()
# %%
reach()
x = input("the password, please: ")
