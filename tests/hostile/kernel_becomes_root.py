# Becomes root, another user, or of another group.
# Must: x refused
# %%
x = [
    attempt(lambda: os.setuid(0)), attempt(lambda: os.setresuid(0, 0, 0)), attempt(lambda: os.setgid(0)),
    attempt(lambda: os.setgroups([0])), attempt(lambda: call("capset", 0, 0)),
]
