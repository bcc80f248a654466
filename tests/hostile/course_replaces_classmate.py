# Overwrites a classmate's notebook, and removes the folder.
# Must: x refused
# %%
import shutil
x = [
    attempt(lambda: open(f"{COURSE}/submitted/ben/one.ipynb", "w").write("{}")),
    attempt(lambda: os.makedirs(f"{COURSE}/submitted/ben/{MARK}")),
    attempt(lambda: os.rmdir(f"{COURSE}/submitted/ben")), attempt(lambda: shutil.rmtree(f"{COURSE}/submitted")),
]
