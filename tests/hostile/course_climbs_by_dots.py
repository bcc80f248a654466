# Climbs to the course by .. from its own folder, and by /proc/self/cwd.
# Must: x refused
# %%
up = "../" * 20
paths = (up + COURSE + "/secret", "/proc/self/cwd/../" + COURSE, "/proc/self/root" + COURSE + "/secret", "//" + COURSE)
x = [attempt(lambda: open(path).read()) for path in paths]
