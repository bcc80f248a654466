# Announces a frame of 2**63 bytes.
# Must: x lost: the notebook wrote more than its answers can hold; y lost: the notebook wrote more than its answers can hold
# %%
reach()
# %%
for number in range(3, 64):
    try: os.write(number, b"\xff" * 7 + b"\x7f")
    except OSError: pass
x = y = 1
