# Sends JSON of other shapes: lists for dicts, text for numbers, negative lengths, names in plenty.
# Must: x lost; y lost; f lost
# %%
import json
values = {
    "x": {"k": "num", "v": {"shape": [-1, 1 << 70], "re": ["a"], "im": {}}},
    "y": {"k": "num", "v": {"shape": [3], "re": [1], "im": [None]}},
    "f": {"k": ["calls"], "v": 7},
    "__class__": [], **{f"n{i}": {} for i in range(5000)},
}
text = json.dumps({"done": "yes", "values": values}).encode()
for number in range(3, 64):
    try: os.write(number, len(text).to_bytes(8, "little") + text)
    except OSError: pass
os._exit(0)
