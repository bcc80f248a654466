# Links the secret into its own folder, hard and symbolic, and moves it there.
# Must: x refused
# %%
x = [
    attempt(lambda: os.link(f"{COURSE}/secret", "mine")), attempt(lambda: os.symlink(f"{COURSE}/secret", "mine")),
    attempt(lambda: os.rename(f"{COURSE}/secret", "mine")), attempt(lambda: open("mine").read()),
]
