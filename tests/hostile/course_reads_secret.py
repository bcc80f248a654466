# Opens the secret of the course, and looks for it in the environment.
# Must: x refused; y is 0
# %%
x = attempt(lambda: open(f"{COURSE}/secret").read())
y = sum("KINEGRADE" in name for name in os.environ)
