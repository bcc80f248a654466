# Raises at every audited event from now on.
# Must: y is 1
# %%
y = 1
# %%
def refuse(event, arguments): raise RuntimeError(event)
reach()
sys.addaudithook(refuse)
