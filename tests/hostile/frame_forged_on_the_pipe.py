# Writes a frame by hand, with other numbers, over every descriptor, and ends: it is marked by what it says.
# Must: x is [41.0]; y is 2
# %%
import json
value = {"k": "num", "v": {"shape": [1], "re": [41.0], "im": []}}
scalar = {"k": "num", "v": {"shape": [], "re": [2.0], "im": []}}
text = json.dumps({"done": True, "values": {"x": value, "y": scalar, "reached": dict(value, v=dict(value["v"], re=[1.0], shape=[]))}}).encode()
for number in range(3, 64):
    try: os.write(number, len(text).to_bytes(8, "little") + text)
    except OSError: pass
os._exit(0)
