# Sends JSON of other shapes: lists for dicts, text for numbers, negative lengths, names in plenty.
# Must: x lost: the value is not one that can be marked; y lost: the value is not one that can be marked; f lost: the value is not one that can be marked
# %%
import json
values = {
    "x": {"k": "num", "v": {"shape": [-1, 1 << 70], "re": ["a"], "im": {}}},
    "y": {"k": "num", "v": {"shape": [3], "re": [1], "im": [None]}},
    "f": {"k": ["calls"], "v": 7},
    "reached": {"k": "num", "v": {"shape": [], "re": [1.0], "im": []}},
    "__class__": [], **{f"n{i}": {} for i in range(5000)},
}
text = json.dumps({"done": "yes", "values": values}).encode()
for number in range(3, 64):
    try: os.write(number, len(text).to_bytes(8, "little") + text)
    except OSError: pass
os._exit(0)
