# Sends bytes that are no JSON, as its last frame.
# Must: x lost: the notebook ended its own process before it finished; y lost: the notebook ended its own process before it finished; reached lost: the notebook ended its own process before it finished
# %%
reach()
# %%
for text in (b"\xff\xfe\x00", b"[" * 100_000, b"NaN", b'"' + b"\\u0000" * 1000 + b'"', b"1e999999"):
    for number in range(3, 64):
        try: os.write(number, len(text).to_bytes(8, "little") + text)
        except OSError: pass
os._exit(0)
