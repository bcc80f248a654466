# Sends integers of a million digits, and numbers that are none.
# Must: x lost: the notebook ended its own process before it finished; reached lost: the notebook ended its own process before it finished
# %%
reach()
# %%
text = b'{"done": true, "values": {"x": {"k": "num", "v": {"shape": [1], "re": [' + b"9" * 1_000_000 + b'], "im": []}}}}'
for number in range(3, 64):
    try: os.write(number, len(text).to_bytes(8, "little") + text)
    except OSError: pass
os._exit(0)
