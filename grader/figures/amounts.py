"""The parameters of a robot with their values, in words and as formulas."""

from collections.abc import Mapping

from ...solutions.expression import latex_name


def said_amounts(values: Mapping[str, float]) -> str:
    """All of them, such as "l1 = 1 m, beta = 0.2 rad"."""
    said = [f"{name} = {value:.5g} {_unit(name)}" for name, value in values.items()]
    return ", ".join(said)


def typeset_amounts(values: Mapping[str, float]) -> list[str]:
    """Each of them as a formula, lengths first; the last of each unit has it."""
    typeset: list[str] = []
    for unit in ("m", "rad"):
        names = [name for name in values if _unit(name) == unit]
        for name in names:
            text = f"${latex_name(name)}={values[name]:.5g}$"
            if name == names[-1]:
                text += f" {unit}"
            typeset.append(text)
    return typeset


def _unit(name: str) -> str:
    """The unit of a parameter: Greek letters are angles, all others lengths."""
    return "rad" if latex_name(name).startswith("\\") else "m"
