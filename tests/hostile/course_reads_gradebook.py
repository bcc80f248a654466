# Opens the gradebook, by its file and by SQLite.
# Must: x refused; y lost: cell 3 stopped with OperationalError: unable to open database file
# %%
x = attempt(lambda: open(f"{COURSE}/gradebook.sqlite", "rb").read())
# %%
import sqlite3
y = sqlite3.connect(f"file:{COURSE}/gradebook.sqlite?mode=ro", uri=True).execute("select * from records").fetchall()
