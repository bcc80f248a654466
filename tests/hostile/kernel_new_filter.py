# Loads a seccomp filter and Landlock rules of its own, to shadow ours.
# Must: x refused
# %%
x = [
    attempt(lambda: call("prctl", 22, 2, 0, 0, 0)), attempt(lambda: call("seccomp", 1, 0, 0)),
    attempt(lambda: call("landlock_create_ruleset", 0, 0, 1)),
]
