# Says that it was stopped from outside, so as to be run again and again.
# Must: x lost: the value is not one that can be marked; y lost: the value is not one that can be marked
# %%
import json
value = {"k": "interrupted", "v": "the notebook was stopped from outside; it will be run again"}
one = {"k": "num", "v": {"shape": [], "re": [1.0], "im": []}}
text = json.dumps({"done": True, "values": {"x": value, "y": value, "reached": one}}).encode()
for number in range(3, 64):
    try: os.write(number, len(text).to_bytes(8, "little") + text)
    except OSError: pass
os._exit(0)
