# Makes a file that seems a terabyte long.
# Must: x refused
# %%
def write():
    with open("sparse", "wb") as file:
        file.seek(1 << 40)
        file.write(b"x")
x = [attempt(write), attempt(lambda: os.truncate("sparse", 1 << 40))]
