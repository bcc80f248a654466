# Switches address randomisation off by personality.
# Must: x refused
# %%
x = attempt(lambda: call("personality", 0x0040000))
