"""A finding without the place in a matrix: the same mistake stands elsewhere for others."""

import re

ONE = r"(?:matrix|row|column|entry) \d+"
PLACE = re.compile(rf"(:|, first at)? {ONE}(?:(?:, | and ){ONE})*")
"""Where in a matrix it is; the same mistake stands elsewhere for others."""
SHAPES = re.compile(r"^Takes shape \([^)]*\), got \([^)]*\): ")


def anywhere(sentence: str) -> str:
    """A sentence without the place in a matrix, and the shapes, of which it speaks."""
    said = SHAPES.sub("", sentence)
    said = PLACE.sub(lambda found: "" if found[1] else " one entry", said)
    return said[:1].upper() + said[1:]
