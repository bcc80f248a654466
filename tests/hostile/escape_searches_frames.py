# Climbs the frames above its cell and looks for answers in what they know.
# Must: x is 0
# %%
frame, x = sys._getframe(), 0
while frame:
    reach()
    x += sum(name in ("expected", "reference", "answer", "key") for name in frame.f_locals)
    frame = frame.f_back
