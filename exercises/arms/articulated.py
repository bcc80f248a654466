"""The articulated arm of S1, Example 2.25, mounted in many ways: the position of its hand, and derivatives of that."""

from collections.abc import Iterable, Mapping
from itertools import product
from typing import Any

from ...solutions.expression_array import ExpressionArray, expression_array
from ..exercise import Variant

Wave = tuple[int, str]  # a sine or cosine and its sign
Coordinate = tuple[Wave | None, Wave]  # what holds q1, None along axis 1; what stands beside a2, a3 and a4
Structure = tuple[str, str, str, int]  # mounting, offsets of joints 1 and 2, sense of joints 2 to 4
LENGTHS = ("d1", "a1", "a2", "a3", "a4")
NAMES = (*LENGTHS, "q1", "q2", "q3", "q4", "q5", "q6")
# Of a joint and its offset.
COSINE: dict[str, Wave] = {"0": (1, "cos"), "pi/2": (-1, "sin"), "-pi/2": (1, "sin"), "pi": (-1, "cos")}
SINE: dict[str, Wave] = {"0": (1, "sin"), "pi/2": (1, "cos"), "-pi/2": (-1, "cos"), "pi": (-1, "sin")}
# What lies along base x, y and z: the way out at the zero of axis 1, beside it, up along axis 1.
MOUNTINGS: dict[str, tuple[tuple[int, str], ...]] = {
    "floor": ((1, "out"), (1, "beside"), (1, "up")),
    "ceiling": ((1, "out"), (-1, "beside"), (-1, "up")),
    "wall x": ((1, "up"), (1, "out"), (1, "beside")),
    "wall y": ((1, "beside"), (1, "up"), (1, "out")),
}
SLOPES: dict[str, Wave] = {"cos": (-1, "sin"), "sin": (1, "cos")}
TERMS = {2: (2, 3, 4), 3: (3, 4), 4: (4,)}  # links that joint 2, 3, 4 moves
SUMS = {2: "q2", 3: "q2 + q3", 4: "q2 + q3 + q4"}
MOUNTED = {
    "floor": "stands on the floor, with axis 1 along base z",
    "ceiling": "hangs from the ceiling, with axis 1 against base z",
    "wall x": "is fixed to a wall, with axis 1 along base x",
    "wall y": "is fixed to a wall, with axis 1 along base y",
}


def coordinates(mounting: str, first: str, second: str, sense: int) -> tuple[Coordinate, ...]:
    """What p_x, p_y, p_z are made of: `first` and `second` are the offsets of joints 1 and 2."""
    reach, height = COSINE[second], SINE[second]
    found: list[Coordinate] = []
    for sign, way in MOUNTINGS[mounting]:
        turn = {"out": COSINE[first], "beside": SINE[first]}.get(way)
        up = sign * sense * height[0], height[1]
        found.append(((sign * turn[0], turn[1]), reach) if turn else (None, up))
    return tuple(found)


def _as_printed(coordinate: Coordinate, printed: Coordinate) -> bool:
    """Whether the derivatives by q2, q3 and q4 are those of a coordinate of S1."""
    signs = [lift[0] * (turn[0] if turn else 1) for turn, lift in (coordinate, printed)]
    names = [(turn[1] if turn else "", lift[1]) for turn, lift in (coordinate, printed)]
    return signs[0] == signs[1] and names[0] == names[1]


PRINTED = coordinates("floor", "0", "0", 1)  # S1, but for d1 and a1
STRUCTURES: tuple[Structure, ...] = tuple(
    structure
    for structure in product(MOUNTINGS, COSINE, ("0", "pi/2", "-pi/2"), (1, -1))
    if not any(map(_as_printed, coordinates(*structure), PRINTED))
)


def structure_of(v: Variant) -> Structure:
    return STRUCTURES[int(v["structure"])]


def summed(terms: Iterable[tuple[int, str]]) -> str:
    """Text of a sum of signed terms."""
    text = "".join(f" {'-' if sign < 0 else '+'} {term}" for sign, term in terms)
    return text.removeprefix(" + ") if text.startswith(" +") else text.replace(" - ", "-", 1)


def position(v: Variant, *, latex: bool = False) -> list[str]:
    """p_x, p_y, p_z, as formulas or with S1's letters C and S."""

    def times(length: str, name: str, angle: str) -> str:
        return rf"{length[0]}_{length[1]}\,{name[0].upper()}_{{{angle}}}" if latex else f"{length}*{name}({angle})"

    found: list[str] = []
    for (up, _), (turn, lift) in zip(MOUNTINGS[structure_of(v)[0]], coordinates(*structure_of(v)), strict=True):
        links = [(lift[0], times(f"a{k}", lift[1], "234"[: k - 1] if latex else SUMS[k])) for k in TERMS[2]]
        reach = summed([(1, "a_1" if latex else "a1"), *links])
        if turn:
            front = f"{turn[1][0].upper()}_1" if latex else f"{turn[1]}(q1)*"
            found.append(summed([(turn[0], f"{front}({reach})")]))
        else:
            found.append(summed([(up, "d_1" if latex else "d1"), *links]))
    return found


def derivatives(
    coordinate: Coordinate,
    *,
    slopes: Mapping[str, Wave] = SLOPES,
    terms: Mapping[int, tuple[int, ...]] = TERMS,
    sums: Mapping[int, str] = SUMS,
    shoulder: bool = True,
) -> ExpressionArray:
    """The derivatives of a coordinate by q1 ... q6; what is passed by name is where a student may go wrong."""
    turn, lift = coordinate
    found = ["0"]
    if turn:
        sign, name = slopes[turn[1]]
        links = [(lift[0], f"a{k}*{lift[1]}({sums[k]})") for k in TERMS[2]]
        found = [summed([(sign * turn[0], f"{name}(q1)*({summed([*[(1, 'a1')] * shoulder, *links])})")])]
    sign, name = slopes[lift[1]]
    front, side = (f"{turn[1]}(q1)*", turn[0]) if turn else ("", 1)
    for joint in (2, 3, 4):
        links = summed((1, f"a{k}*{name}({sums[k]})") for k in terms[joint])
        found.append(summed([(sign * lift[0] * side, f"{front}({links})")]))
    return expression_array([*found, "0", "0"], NAMES)


def row(v: Variant, i: int, **wrong: Any) -> ExpressionArray:
    """Row i of the linear block."""
    return derivatives(coordinates(*structure_of(v))[i], **wrong)
