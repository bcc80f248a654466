"""Quantities: a number, perhaps a formula, and a unit."""

import math

import pytest
from kinegrade.exercises.units import (
    UNITS,
    UnitError,
    converted,
    dimension,
    refuse_unknown_unit,
)
from kinegrade.grader.reading.quantities import typed_quantity
from kinegrade.solutions.expression import ExpressionError


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
        ("19.6 N m", 19.6, "N m"),
        ("19.6 Nm", 19.6, "N m"),
        ("5 N*m", 5, "N m"),
        ("5 N·m", 5, "N m"),
        ("5 N.m", 5, "N m"),
        ("19600 N mm", 19.6, "N m"),
        ("3 kN", 3000, "N"),
        ("2 kNm", 2000, "N m"),
        ("12 J", 12, "J"),
        ("1.5 kW", 1500, "W"),
        ("9.81 m/s^2", 9.81, "m/s^2"),
        ("9.81 m/s²", 9.81, "m/s^2"),
        ("2 rad / s**2", 2, "rad/s^2"),
        ("250 g", 0.25, "kg"),
        ("0.4 kg*m^2", 0.4, "kg m^2"),
        ("50 Hz", 50, "Hz"),
        ("3 N m s/rad", 3, "N m s/rad"),
        ("3 N*m*s/rad", 3, "N m s/rad"),
        ("3 1/s", 3, "1/s"),
        ("2*3 N/m", 6, "N/m"),
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
        ("3 m^4", 2, "unknown unit 'm^4'"),
        ("3 m N", 2, "unknown unit 'm N'"),
        (
            "3 Ns",
            2,
            "unknown unit 'Ns'; known: m, km, cm, mm, s, ms, Hz, rad, deg, °, rpm, kg, g, N, kN, J, kJ, W, kW, and",
        ),
        ("3 m m", 2, "unknown unit 'm m'"),
        ("2 q1", 2, "unknown unit 'q1'"),
        ("5,3 m", 1, "a decimal number takes a point"),
        ("m", 0, "the formula stops"),
        ("2/s", 2, "the formula stops"),
        ("", 0, "the formula stops"),
        ("2 * x m", 4, "unknown name 'x'"),
        ("1/0 m", 1, "division by zero"),
        ("5° 3", 1, "'°' has no place here"),
        ("9" * 500, 0, "a number takes a size between"),
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


@pytest.mark.parametrize(
    ("unit", "nearest"),
    [("Nm", "N m"), ("m/sec", "m/s"), ("radians", "rad"), ("N*m", "N m"), ("rad/s2", "rad/s^2")],
)
def test_an_unknown_unit_is_refused_with_the_nearest(unit: str, nearest: str):
    with pytest.raises(UnitError) as caught:
        refuse_unknown_unit(unit)
    assert str(caught.value).startswith(f"unknown unit {unit!r}; the nearest is {nearest!r}")


@pytest.mark.parametrize("unit", [*UNITS])
def test_every_unit_of_the_list_is_known(unit: str):
    refuse_unknown_unit(unit)


def test_what_is_no_text_is_no_unit():
    with pytest.raises(UnitError, match="a unit takes text such as 'm', got 3"):
        refuse_unknown_unit(3)


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("rad", "1", True),
        ("deg/s", "1/s", True),
        ("m/rad", "mm", True),
        ("J", "N m", True),
        ("N m/rad", "kN m", True),
        ("Hz", "rad/s", False),  # a turn is not a radian
        ("N", "N m", False),
        ("N m", "m", False),
        ("", "1", True),
    ],
)
def test_units_measure_the_same_where_angles_have_no_dimension(one: str, other: str, *, same: bool):
    assert (dimension(one) == dimension(other)) is same


def test_a_value_is_brought_to_the_asked_unit():
    assert converted(0.35, "mm") == 350.0
    assert converted(0.35, "m") == 0.35
    assert converted(math.pi, "deg") == pytest.approx(180)
