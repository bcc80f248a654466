# Opens worked solutions and the exercise's own file.
# Must: x refused
# %%
x = [attempt(lambda: open(f"{COURSE}/{name}").read()) for name in ("solutions/lever.py", "exercises/lever.py")]
