"""Units of sheets and answers: their factors to SI, their dimensions, the nearest to a typo."""

import math
from collections.abc import Mapping
from fractions import Fraction
from types import MappingProxyType
from typing import NamedTuple

from ..solutions.errors import KinegradeError, nearest


class UnitError(KinegradeError):
    """A unit that nobody knows."""


class Unit(NamedTuple):
    """A unit as a factor times its SI unit."""

    factor: float  # to SI
    si: str


_DEGREE = math.pi / 180
UNITS: Mapping[str, Unit] = MappingProxyType({
    "1": Unit(1.0, ""),
    "m": Unit(1.0, "m"), "km": Unit(1e3, "m"), "cm": Unit(1e-2, "m"), "mm": Unit(1e-3, "m"),
    "m^2": Unit(1.0, "m^2"), "m^3": Unit(1.0, "m^3"), "1/m": Unit(1.0, "1/m"),
    "s": Unit(1.0, "s"), "ms": Unit(1e-3, "s"), "1/s": Unit(1.0, "1/s"), "Hz": Unit(1.0, "Hz"),
    "rad": Unit(1.0, "rad"), "deg": Unit(_DEGREE, "rad"), "°": Unit(_DEGREE, "rad"),
    "m/s": Unit(1.0, "m/s"), "cm/s": Unit(1e-2, "m/s"), "mm/s": Unit(1e-3, "m/s"),
    "m/s^2": Unit(1.0, "m/s^2"), "mm/s^2": Unit(1e-3, "m/s^2"),
    "rad/s": Unit(1.0, "rad/s"), "deg/s": Unit(_DEGREE, "rad/s"), "°/s": Unit(_DEGREE, "rad/s"),
    "rpm": Unit(math.tau / 60, "rad/s"),
    "rad/s^2": Unit(1.0, "rad/s^2"),
    "deg/s^2": Unit(_DEGREE, "rad/s^2"), "°/s^2": Unit(_DEGREE, "rad/s^2"),
    "m/rad": Unit(1.0, "m/rad"), "cm/rad": Unit(1e-2, "m/rad"), "mm/rad": Unit(1e-3, "m/rad"),
    "m/rad^2": Unit(1.0, "m/rad^2"), "rad/m": Unit(1.0, "rad/m"), "1/rad": Unit(1.0, "1/rad"),
    "kg": Unit(1.0, "kg"), "g": Unit(1e-3, "kg"), "kg m^2": Unit(1.0, "kg m^2"),
    "N": Unit(1.0, "N"), "kN": Unit(1e3, "N"),
    "N m": Unit(1.0, "N m"), "kN m": Unit(1e3, "N m"),
    "N cm": Unit(1e-2, "N m"), "N mm": Unit(1e-3, "N m"),
    "N/m": Unit(1.0, "N/m"), "N/mm": Unit(1e3, "N/m"), "N m/rad": Unit(1.0, "N m/rad"),
    "N s/m": Unit(1.0, "N s/m"), "N m s/rad": Unit(1.0, "N m s/rad"),
    "J": Unit(1.0, "J"), "kJ": Unit(1e3, "J"), "W": Unit(1.0, "W"), "kW": Unit(1e3, "W"),
})  # fmt: skip
"""All units that a sheet, an answer or a student may use; the SI ones have the factor 1."""
DIMENSIONS: Mapping[str, str] = MappingProxyType({
    "": "1", "rad": "1", "1/rad": "1", "rad/s": "1/s", "rad/s^2": "1/s^2",
    "m/rad": "m", "m/rad^2": "m", "rad/m": "1/m",
    "J": "N m", "W": "N m/s", "N m/rad": "N m", "N m s/rad": "N m s",
})  # fmt: skip
"""What SI units come to where angles have no dimension; Hz stays: a turn is not a radian."""


def _spellings() -> dict[str, str]:
    """Every way to write a unit, in the form in which tokens are joined, to its name."""
    found = dict[str, str]()
    for name in UNITS:
        for between in (" ", "", "*", "."):
            found[name.replace(" ", between)] = name
    return found


SPELLINGS: Mapping[str, str] = MappingProxyType(_spellings())


def refuse_unknown_unit(unit: object) -> None:
    """Refuses what is none of `UNITS`.

    Raises:
        UnitError: it is none; the sentence has the nearest one.
    """
    if not isinstance(unit, str):
        raise UnitError(f"a unit takes text such as 'm', got {unit!r}")
    if unit in UNITS:
        return
    near = SPELLINGS.get(unit) or _abbreviated(unit) or nearest(unit, UNITS, cutoff=0)
    raise UnitError(
        f"unknown unit {unit!r}; the nearest is {near!r}, and kinegrade.exercises.units lists all"
    )


def _abbreviated(unit: str) -> str:
    """The longest unit that a word such as "radians" begins with; empty when there is none."""
    longest = ""
    for name in UNITS:
        if not unit.startswith(name) or len(name) <= len(longest):
            continue
        if unit.removeprefix(name).isalpha():
            longest = name
    return longest


def dimension(unit: str) -> str:
    """What a unit measures, angles aside: rad and 1 are the same, so are J and N m.

    The empty text is no unit.
    """
    si = UNITS[unit].si if unit else ""
    return DIMENSIONS.get(si, si)


def converted(value: float, unit: str) -> float:
    """A value in SI as a number of the unit: 0.35 [m] are 350 [mm]."""
    factor = UNITS[unit].factor
    if factor == 1:
        return value
    # exactly, since 0.35 / 0.001 is 349.99999999999994
    exact = Fraction(value) / Fraction(repr(factor))
    return float(exact)
