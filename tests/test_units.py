"""Quantities: a number, perhaps a formula, and a unit."""

import math

import pytest
from kinegrade.solutions.expression import ExpressionError
from kinegrade.solutions.units import UNITS, typed_quantity


@pytest.mark.parametrize(
    ("text", "value", "si"),
    [
        ("0.35 m", 0.35, "m"),
        ("350mm", 0.35, "m"),
        ("35 cm", 0.35, "m"),
        ("1.2e-3 km", 1.2, "m"),
        ("sqrt(2)/2 m", math.sqrt(2) / 2, "m"),
        ("√2 m", math.sqrt(2), "m"),
        ("1/2 m/s", 0.5, "m/s"),
        ("−5 mm/s", -0.005, "m/s"),
        ("20 deg/s", math.radians(20), "rad/s"),
        ("20 deg / s", math.radians(20), "rad/s"),
        ("20°/s", math.radians(20), "rad/s"),
        ("90 °", math.pi / 2, "rad"),
        ("pi/2 rad", math.pi / 2, "rad"),
        ("30 rpm", math.pi, "rad/s"),
        ("20 mm/rad", 0.02, "m/rad"),
        ("15 ms", 0.015, "s"),
        ("0.3", 0.3, ""),
        ("2*pi", 2 * math.pi, ""),
    ],
)
def test_quantities_are_read_in_si(text: str, value: float, si: str):
    found, unit = typed_quantity(text)
    assert unit == si
    assert found == pytest.approx(value, rel=1e-15)


def test_millimetres_are_exact():
    assert typed_quantity("350 mm") == (0.35, "m")


@pytest.mark.parametrize("unit", [unit for unit in UNITS if unit != "1"])
def test_every_unit_is_its_factor_of_the_si_unit(unit: str):
    factor, si = UNITS[unit]
    assert typed_quantity(f"1 {unit}") == (pytest.approx(factor), si)
    assert UNITS[si].factor == 1


@pytest.mark.parametrize(
    ("text", "offset", "message"),
    [
        ("3 parsec", 2, "unknown unit 'parsec'; known: m, km, cm, mm"),
        ("3 M", 2, "unknown unit 'M'"),
        ("3 m/min", 2, "unknown unit 'm/min'"),
        ("3 m^2", 2, "unknown unit 'm^2'"),
        ("3 m m", 2, "unknown unit 'm m'"),
        ("2 q1", 2, "unknown unit 'q1'"),
        ("5,3 m", 1, "a decimal number takes a point"),
        ("m", 0, "the formula stops"),
        ("2/s", 2, "the formula stops"),
        ("", 0, "the formula stops"),
        ("2 * x m", 4, "unknown name 'x'"),
        ("1/0 m", 1, "division by zero"),
        ("5° 3", 1, "'°' has no place here"),
        ("9" * 500, 400, "a formula takes up to 400 characters"),
    ],
)
def test_what_is_no_quantity_is_refused_at_its_place(text: str, offset: int, message: str):
    with pytest.raises(ExpressionError) as caught:
        typed_quantity(text)
    assert caught.value.message.startswith(message)
    assert caught.value.offset == offset
    assert caught.value.text == text


def test_what_is_no_text_is_refused():
    with pytest.raises(ExpressionError, match="a quantity takes text, got float"):
        typed_quantity(3.5)
