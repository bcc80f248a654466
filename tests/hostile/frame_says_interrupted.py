# Says that it was stopped from outside, so as to be run again and again.
# Must: x lost; y lost
# %%
import json
value = {"k": "interrupted", "v": "the notebook was stopped from outside; it will be run again"}
text = json.dumps({"done": True, "values": {"x": value, "y": value}}).encode()
for number in range(3, 64):
    try: os.write(number, len(text).to_bytes(8, "little") + text)
    except OSError: pass
os._exit(0)
