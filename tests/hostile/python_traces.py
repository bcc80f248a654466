# Watches and changes our code by sys.settrace, sys.setprofile and an audit hook.
# Must: y lost
# %%
y = 1
# %%
def watch(frame, event, argument):
    frame.f_locals["values"] = {"x": {"k": "num"}}
    return watch
sys.settrace(watch)
sys.setprofile(watch)
sys.addaudithook(lambda *a: None)
