"""One submission collected and marked, from plain data alone, and where that is done."""
