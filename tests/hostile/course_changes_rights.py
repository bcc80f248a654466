# Makes the secret readable for all, changes its owner, and its attributes.
# Must: x refused
# %%
path = f"{COURSE}/secret"
x = [
    attempt(lambda: os.chmod(path, 0o777)), attempt(lambda: os.chown(path, 65534, 65534)),
    attempt(lambda: os.setxattr(path, "user.a", b"b")), attempt(lambda: os.chmod(COURSE, 0)),
]
