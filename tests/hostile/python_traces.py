# Watches and changes our code by sys.settrace, sys.setprofile and an audit hook.
# Must: x lost: the value is not one that can be marked
# %%
y = 1
# %%
one = {"k": "num", "v": {"shape": [], "re": [1.0], "im": []}}
def watch(frame, event, argument):
    frame.f_locals["values"] = {"x": {"k": "num"}, "reached": one}
    return watch
sys.settrace(watch)
sys.setprofile(watch)
sys.addaudithook(lambda *a: None)
