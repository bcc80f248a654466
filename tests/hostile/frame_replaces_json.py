# Replaces json, struct and os.write, by which answers are handed over.
# Must: x is 1; y is 2
# %%
import json, struct
json.dumps = json.dump = lambda *a, **k: "{}"
struct.pack = lambda *a: b""
os.write = lambda *a: 0
reach()
x = 1
# %%
y = 2
