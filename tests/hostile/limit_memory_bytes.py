# Doubles a text until memory ends.
# Must: x lost; y is 2
# %%
text = b"x" * 1024
while True: text += text
x = 1
# %%
y = 2
