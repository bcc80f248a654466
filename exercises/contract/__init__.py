"""What stands behind part.py: names on a sheet, docstrings, and what an arm says by itself."""
