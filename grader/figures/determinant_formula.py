# pyright: basic
"""The determinant of a drawn block as a product of named factors, where that is what it is."""

import re
from typing import TYPE_CHECKING

import numpy as np

from ...solutions.expression import latex_name, parse
from ...solutions.singularity import Parameters, Values, factor_values, task_block
from .joint_map import JointMap

if TYPE_CHECKING:
    from ...solutions.robots import Robot

# Two configurations at which the product is compared with the determinant.
TRIED = np.array([[0.3, 0.7, 0.4, -0.5, 0.6, 0.2], [0.3, -1.1, 1.3, 0.9, -0.8, 0.5]])


def determinant_formula(robot: "Robot", found: JointMap, parameters: Parameters) -> str | None:
    """The robot's constant times its factors, in LaTeX.

    None where the determinant of the drawn block is not that product, or cannot be written short.
    """
    factors = found.part.factors
    if found.det is None or not factors:
        return None
    constant = _shorthand(robot.constant, 1)
    product = [_shorthand(factor.expression, factor.power) for factor in factors]
    if constant is None or None in product:
        return None
    sign = _sign(_determinant_over_product(robot, found, parameters))
    if sign is None:
        return None

    if constant.startswith("-"):
        sign = -sign
    lengths = constant.lstrip("-")
    if lengths != "1":
        product.insert(0, lengths)
    minus = "-" if sign < 0 else ""
    written = r"\,".join(map(str, product))
    return rf"$\det\mathbf{{A}}={minus}{written}$"


def _sign(ratio: Values) -> int | None:
    """1 or -1 where the determinant is the stated product up to sign, None where it is not."""
    # The wrist's part of a constant is of size 1.
    if not np.allclose(np.abs(ratio), 1.0) or ratio[0] * ratio[1] < 0:
        return None
    return -1 if ratio[0] < 0 else 1


def _determinant_over_product(robot: "Robot", found: JointMap, parameters: Parameters) -> Values:
    """The block's determinant over the stated product, at each configuration tried."""
    q = TRIED[:, : robot.n]
    values = factor_values(robot, parameters, q)
    product = parse(robot.constant, robot.names).at(robot.values(parameters))
    product = product * np.prod([values[f.name] ** f.power for f in found.part.factors], axis=0)
    block = task_block(found.part, q[:, : found.part.chain.n])
    with np.errstate(divide="ignore", invalid="ignore"):  # a length may be zero
        return np.linalg.det(block) / product


def _shorthand(expression: str, power: int) -> str | None:
    """A sum of products in the course's shorthand, s_23 for sin(q2 + q3); else None."""
    text = re.sub(r"(sin|cos)\(([q0-9 +]+)\)", _subscripted, expression)
    if re.search(r"[(/^]|\*\*", text):
        return None
    terms = []
    for term in re.split(r"(?= [+-] )", text):
        symbols = [_symbol(factor) for factor in term.split("*")]
        terms.append(r"\,".join(symbols))

    text = "".join(terms)
    if len(terms) > 1:
        text = f"({text})"
    return text if power == 1 else f"{text}^{power}"


def _subscripted(call: re.Match[str]) -> str:
    """s_{23} for the text sin(q2 + q3)."""
    joints = re.sub("[q +]", "", call[2])
    return f"{call[1][0]}_{{{joints}}}"


def _symbol(text: str) -> str:
    sign, name = re.findall(r"^(\s*[+-]?\s*)(.*?)\s*$", text)[0]
    if "{" not in name:
        name = latex_name(name)
    return sign.strip() + name
