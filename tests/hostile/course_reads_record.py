# Opens what the course keeps of the sheets that it handed out.
# Must: x refused
# %%
names = ("record.json", "roster.csv", "course.toml", ".git/config")
x = [attempt(lambda: open(f"{COURSE}/{name}").read()) for name in names]
