"""What a name may stand for: s12, c_23, theta_1, np.sin and rrt_l1 are shorthands students use."""

from collections.abc import Callable, Iterator

from ...solutions.expression import CALLED

Names = frozenset[str]

MODULES = ("", "np", "numpy", "math", "sp", "sympy")
ALIASES = {
    "arcsin": "asin", "arccos": "acos", "arctan": "atan", "arctan2": "atan2",
    "tg": "tan", "arctg": "atan", "cosec": "csc", "ctg": "cot", "fabs": "abs", "absolute": "abs",
}  # fmt: skip
RECIPROCALS = {"sec": "cos", "csc": "sin", "cot": "tan"}
WORDS = frozenset({*CALLED, *RECIPROCALS, "pi"})
SHORT = {
    "s": "sin", "S": "sin", "sin": "sin", "sth": "sin", "stheta": "sin",
    "c": "cos", "C": "cos", "cos": "cos", "cth": "cos", "ctheta": "cos",
}  # fmt: skip
JOINTS = ("q", "theta", "th")
OPERATORS = ("d", "dot", "ddot", "delta", "minus", "neg")  # d_q1 is no q1
NO_PREFIX = frozenset({*WORDS, *SHORT, *ALIASES, *JOINTS, *OPERATORS})


def readings(name: str, names: Names) -> set[str]:
    """Formulas that a name may stand for, itself where it is known; none where it means nothing."""
    if name in names or name in WORDS:
        return {name}
    found = _respelled(name, names)
    if found:
        return found
    for reading in READINGS:
        found |= reading(name, names)
    return found


def _respelled(name: str, names: Names) -> set[str]:
    """l_1 is l1, d3 is d_3."""
    if name in names:
        return {name}
    meant = _indexed(name)
    return {known for known in names if _indexed(known) == meant}


def _indexed(name: str) -> tuple[str, str]:
    """Stem and index: s_12 is s and 12."""
    stem = name.rstrip("0123456789")
    return stem.removesuffix("_"), name[len(stem) :]


def _other_case(name: str, names: Names) -> set[str]:
    """L1 is l1."""
    meant = _indexed(name.lower())
    return {known for known in names if _indexed(known.lower()) == meant}


def _function(name: str, names: Names) -> set[str]:
    """np.sin, Sin and arcsin are functions of ours, math.pi is pi."""
    module, _, word = name.rpartition(".")
    word = ALIASES.get(word.lower(), word.lower())
    if module in MODULES and word in WORDS:
        return {word}
    return set()


def _joint(name: str, names: Names) -> set[str]:
    """theta1 and th_1 are q1."""
    stem, digits = _indexed(name)
    if stem not in JOINTS or not digits:
        return set()
    return {f"{joint}{digits}" for joint in JOINTS} & names


def _sine(name: str, names: Names) -> set[str]:
    """s12 is sin(q1 + q2); sin1 may be sin(1) as well."""
    stem, digits = _indexed(name)
    if stem not in SHORT:
        return set()

    found = set[str]()
    for joints in _sums(digits, names):
        found.add(f"{SHORT[stem]}({' + '.join(joints)})")
    if found and name == stem + digits and stem in WORDS:
        found.add(f"{stem}({digits})")
    return found


def _sums(digits: str, names: Names, least: int = 1) -> Iterator[tuple[str, ...]]:
    """The ways to cut digits into rising joints: 12 is q1 and q2, and q12 where there is one."""
    for cut in range(1, min(2, len(digits)) + 1):
        number = digits[:cut]
        joint = f"q{number}"
        if joint not in names or int(number) < least:
            continue
        if cut == len(digits):
            yield (joint,)
        for rest in _sums(digits[cut:], names, int(number) + 1):
            yield (joint, *rest)


def _tangent(name: str, names: Names) -> set[str]:
    """t1 may be q1 or tan(q1)."""
    stem, digits = _indexed(name)
    joint = f"q{digits}"
    if stem == "t" and joint in names:
        return {joint, f"tan({joint})"}
    return set()


def _prefixed(name: str, names: Names) -> set[str]:
    """rrt_d1 is d1; a single letter or what has a meaning of its own is no prefix."""
    found = set[str]()
    for place, letter in enumerate(name):
        if letter == "_" and _is_prefix(name[:place], names):
            rest = name[place + 1 :]
            found |= _respelled(rest, names) or _joint(rest, names)
    return found


def _is_prefix(start: str, names: Names) -> bool:
    return len(start) > 1 and start not in NO_PREFIX and not _has_meaning(start, names)


def _has_meaning(name: str, names: Names) -> bool:
    if _respelled(name, names):
        return True
    return any(reading(name, names) for reading in SHORTHANDS)


Reading = Callable[[str, Names], set[str]]
SHORTHANDS: tuple[Reading, ...] = (_other_case, _function, _joint, _sine, _tangent)
READINGS: tuple[Reading, ...] = (*SHORTHANDS, _prefixed)
