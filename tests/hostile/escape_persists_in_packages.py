# Writes a .pth file, a sitecustomize and a changed numpy, for those who come next.
# Must: x refused
# %%
def write(path):
    with open(path, "w") as file: file.write("import os")
inside = os.path.dirname(os.path.dirname(np.__file__))
x = []
for folder in (SITE, inside, ENGINE, os.path.dirname(os.__file__)):
    for name in (MARK + ".pth", "sitecustomize.py", "usercustomize.py", "numpy/__init__.py", "start.py"):
        x.append(attempt(lambda: write(f"{folder}/{name}")))
