# Leaves files whose names are no text, options of programs, or end the line.
# Must: x is 1
# %%
for name in (b"\xff\xfe", b"-rf", b"a\nb", b"\x1b[2J", b" ", b"*", b"~", b"..."):
    os.mkdir(name)
    open(os.path.join(name, name), "w").close()
reach()
x = 1
