# Puts an exercise into the course, which the grader would run.
# Must: x refused
# %%
def write(path):
    with open(path, "w") as file: file.write(f"import os\nos.system('touch /tmp/{MARK}')")
x = [attempt(lambda: write(f"{COURSE}/exercises/{name}.py")) for name in ("lever", MARK)]
