# Puts a key into the kernel's keyring and looks for those of others.
# Must: process ended
# %%
call("add_key", b"user", b"a", b"b", 1, -3)
