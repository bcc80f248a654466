# Opens a classmate's submission, by name and by listing the folder.
# Must: x refused
# %%
x = [
    attempt(lambda: open(f"{COURSE}/submitted/ben/one.ipynb").read()),
    attempt(lambda: os.listdir(f"{COURSE}/submitted")),
    attempt(lambda: os.listdir("..")),
]
