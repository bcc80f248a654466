# Overwrites the file that was handed in beside it.
# Must: x is 1; y refused
# %%
with open("measured.csv", "w") as file: file.write("9,9")
x = 1
y = attempt(lambda: open(f"{COURSE}/submitted/ada/measured.csv", "w"))
