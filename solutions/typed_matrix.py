"""Stand-in until the language lands."""

from collections.abc import Collection

from .expression import Expression, parse


def typed_matrix(text: str, names: Collection[str]) -> list[list[Expression]]:
    rows = text.replace("Matrix(", "").replace(")]])", ")]]").strip().strip("[]").split("],")
    return [[parse(c.strip().strip("[]"), names) for c in row.split(",")] for row in rows]


def typed_equations(text: str, names: Collection[str]) -> list[Expression]:
    left, _, right = text.partition("=")
    return [parse(f"({left}) - ({right or 0})", names)]
