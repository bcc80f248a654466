# Hands in a text of fifty million letters.
# Must: x lost; y is 1
# %%
x, y = "q" * 50_000_000, 1
