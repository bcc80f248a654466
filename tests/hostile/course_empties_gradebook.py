# Empties, truncates, renames and removes the gradebook.
# Must: x refused
# %%
book = f"{COURSE}/gradebook.sqlite"
x = [
    attempt(lambda: open(book, "w")), attempt(lambda: os.truncate(book, 0)),
    attempt(lambda: os.open(book, os.O_RDONLY | os.O_TRUNC)), attempt(lambda: os.rename(book, book + ".old")),
    attempt(lambda: os.unlink(book)), attempt(lambda: os.utime(book, (0, 0))),
]
