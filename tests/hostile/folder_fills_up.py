# Fills its folder until nothing fits any more, and still has an answer.
# Must: x is 1
# %%
x = 1
# %%
reach()
for i in range(40):
    with open(f"f{i}", "wb") as file: file.write(bytes(2 << 20))
