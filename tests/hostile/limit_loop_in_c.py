# Computes for ever inside one call, where no alarm is heard.
# Must: x stopped
# Seconds: 3
# %%
x = 10 ** 10 ** 8
