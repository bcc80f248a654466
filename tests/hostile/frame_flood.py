# Sends millions of small frames.
# Must: x lost: the notebook wrote more than its answers can hold; y lost: the notebook wrote more than its answers can hold; reached lost: the notebook wrote more than its answers can hold
# %%
reach()
# %%
import signal, stat
for bell in (14, 27): signal.signal(bell, signal.SIG_IGN)
pipes = []
for number in range(3, 64):
    try:
        if stat.S_ISFIFO(os.fstat(number).st_mode): pipes.append(number)
    except OSError: pass
many = (8).to_bytes(8, "little") + b"12345678"
many *= 4096
for number in pipes:
    for _ in range(10_000): os.write(number, many)
x = y = 1
