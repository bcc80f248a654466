# Doubles a text until memory ends.
# Must: x lost: cell 2 needed more memory than there is for a notebook; y is 2
# Seconds: 90
# Cell seconds: 30
# %%
reach()
text = b"x" * 1024
while True: text += text
x = 1
# %%
y = 2
