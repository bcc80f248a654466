"""How much a notebook may hand over; a test compares these with what the wire accepts."""

# As in wire.py and ask.py:
MAX_ELEMENTS = 4096
MAX_ROWS = 64
MAX_SAID = 400
MAX_TEXT = 20_000
MAX_CALLS = 200
# Of the student's process alone:
MAX_CODE = 4 << 20  # characters of all code cells; outputs are dropped before
MAX_FRAME = 1_900_000
