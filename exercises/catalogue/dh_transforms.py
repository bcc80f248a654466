"""S2: from a Denavit-Hartenberg table to the transforms of the links and of the frames.

S2 prints its columns as theta, alpha, r, d, other texts in other orders; here the order is drawn, so that labels have to
be read. Its chain T_0^0 T_1^0 T_2^0 ... is a known mistake: taken literally it stops a link short, or has link 1 twice.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.chain import from_standard, modified_transform, standard_transform
from ..drawing import Drawing, Triad
from ..draws import angles, length, until
from ..exercise import Exercise, Formulas, Given, Mistake, Numbers, Outcome, Part, Step, Variant

Array = NDArray[np.float64]
KINDS = ("RRP", "RPR")
ORDERS = (
    ("theta", "alpha", "a", "d"),
    ("alpha", "a", "d", "theta"),
    ("a", "alpha", "d", "theta"),
    ("theta", "d", "a", "alpha"),
)
LENGTHS = ("a1", "a2", "a3", "d1", "d2", "d3")
SIGN = {1: "", -1: "-"}
SHIFTS = {-90: " - pi/2", 90: " + pi/2", 180: " + pi"}
QUARTERS = (-90, 0, 90, 180)
MOST_ZEROS = 0.2  # share of the entries that are zero only in a wrong pose
PLAIN = 0.08  # smallest entry of a rotation that is not zero, and how far the others stay from one


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A table of three rows with one negative length, whose frames hide no mistake."""
    drawn: dict[str, Any] = until(lambda: _table(rng), _is_telling)
    return drawn


def _table(rng: np.random.Generator) -> dict[str, Any]:
    kinds = KINDS[int(rng.integers(len(KINDS)))]
    v: dict[str, Any] = {"kinds": kinds, "order": int(rng.integers(len(ORDERS)))}
    v["alpha"] = [int(rng.choice([-90, 90])), *(int(x) for x in rng.choice(QUARTERS, 2))]
    v["offset"] = [int(rng.choice([-90, 90, 180])), *(int(x) for x in rng.choice(QUARTERS, 2))]
    names = ["a1", "d1"]
    for i, kind in enumerate(kinds[1:], 2):
        choices = ([f"a{i}"], [f"d{i}"], [f"a{i}", f"d{i}"]) if kind == "R" else ([f"a{i}"],)
        names += choices[int(rng.integers(len(choices)))]
    v |= {name: length(rng, 0.2, 0.9) for name in names}
    v[names[int(rng.integers(len(names)))]] *= -1
    turns = angles(rng, 3)
    for i, kind in enumerate(kinds, 1):
        v |= {f"q{i}": turns[i - 1]} if kind == "R" else {f"s{i}": length(rng, 0.2, 0.9)}
    return v


def _is_telling(v: Variant) -> bool:
    """No entry hides a sign, and poses from wrong links are as full as the right ones, so that they can be followed."""
    poses = frames(v, {"dh_transforms_links": links(v, {})})
    sizes = np.abs(poses[:, :3, :3])
    plain = (sizes < 1e-9) | (sizes > 1 - 1e-9) | ((sizes > PLAIN) & (sizes < 1 - PLAIN / 4))
    wrong = (modified_transform(rows(v)), standard_transform(rows(v, offsets=False)))
    followed = np.array([frames(v, {"dh_transforms_links": own}) for own in wrong])
    full = (np.abs(followed) < 1e-3)[:, ~np.isclose(np.abs(poses) * (1 - np.abs(poses)), 0)].mean(axis=1) < MOST_ZEROS
    return bool(plain.all() and full.all()) and abs(abs(v["a1"]) - abs(v["d1"])) > 0.05


def rows(v: Variant, *, offsets: bool = True, joints: bool = True) -> Array:
    """Numbers (3, 4) of the table in the order theta, d, a, alpha [rad, m], with the joints' values or at zero."""
    table = np.zeros((3, 4))
    for i, kind in enumerate(v["kinds"], 1):
        value = (v[f"q{i}"] if kind == "R" else v[f"s{i}"]) if joints else 0.0
        offset = np.radians(v["offset"][i - 1]) if offsets else 0.0
        theta, d = (offset + value, v.get(f"d{i}", 0.0)) if kind == "R" else (offset, value)
        table[i - 1] = theta, d, v.get(f"a{i}", 0.0), np.radians(v["alpha"][i - 1])
    return table


def first_link(v: Variant, a: str = "a1", d: str = "d1", alpha: int = 1, *, offset: bool = True) -> list[list[str]]:
    """Formulas of Rz(theta) Tz(d) Tx(a) Rx(alpha) for row 1; `alpha` is -1 where it is turned the other way."""
    theta, turn = f"q1{SHIFTS[v['offset'][0]] if offset else ''}", alpha * v["alpha"][0] // 90
    c, s, plus, minus = f"cos({theta})", f"sin({theta})", SIGN[turn], SIGN[-turn]
    return [
        [c, "0", f"{plus}{s}", f"{a}*{c}"],
        [s, "0", f"{minus}{c}", f"{a}*{s}"],
        ["0", f"{plus}1", "0", d],
        ["0", "0", "0", "1"],
    ]


def first_link_modified(v: Variant, _: Given) -> list[list[str]]:
    """The same row as Rx(alpha) Tx(a) Rz(theta) Tz(d)."""
    theta, turn = f"q1{SHIFTS[v['offset'][0]]}", v["alpha"][0] // 90
    c, s, plus, minus = f"cos({theta})", f"sin({theta})", SIGN[turn], SIGN[-turn]
    return [
        [c, f"-{s}", "0", "a1"],
        ["0", "0", f"{minus}1", f"{minus}d1"],
        [f"{plus}{s}", f"{plus}{c}", "0", "0"],
        ["0", "0", "0", "1"],
    ]


def first_link_in_degrees(v: Variant, *, theta: bool = True, alpha: bool = True) -> list[list[str]]:
    """Row 1 with the degrees of these two columns in sines and cosines of radians."""
    turn = f"q1 {v['offset'][0]:+d}" if theta else f"q1{SHIFTS[v['offset'][0]]}"
    twist = str(v["alpha"][0]) if alpha else f"{SIGN[v['alpha'][0] // 90]}pi/2"
    c, s, ca, sa = f"cos({turn})", f"sin({turn})", f"cos({twist})", f"sin({twist})"
    return [
        [c, f"-{s}*{ca}", f"{s}*{sa}", f"a1*{c}"],
        [s, f"{c}*{ca}", f"-{c}*{sa}", f"a1*{s}"],
        ["0", sa, ca, "d1"],
        ["0", "0", "0", "1"],
    ]


def links(v: Variant, _: Given) -> Array:
    """T_0^1, T_1^2, T_2^3."""
    return standard_transform(rows(v))


def frames(_: Variant, given: Given) -> Array:
    """T_0^2, T_0^3."""
    first, second, third = given["dh_transforms_links"]
    return np.array([first @ second, first @ second @ third])


def exchanged_lengths(v: Variant, _: Given) -> Array:
    return standard_transform(rows(v)[:, [0, 2, 1, 3]])


def links_in_degrees(v: Variant, *, theta: bool = True, alpha: bool = True) -> Array:
    """The degrees of these two columns taken for radians."""
    table = rows(v, offsets=not theta)
    if theta:
        table[:, 0] += v["offset"]
    if alpha:
        table[:, 3] = v["alpha"]
    return standard_transform(table)


def literal_chain(_: Variant, given: Given) -> Array:
    """S2's T_0^0 T_1^0 T_2^0 as it stands: poses in frame 0 multiplied with each other."""
    first, second, _third = given["dh_transforms_links"]
    return np.array([first, first @ first @ second])


def unpaid(v: Variant, given: Given, value: Any) -> Outcome:
    """A check by which the literal chain, which meets some columns by chance, earns nothing."""
    return Outcome(share=0.0 if np.abs(value - literal_chain(v, given)).max() <= 2e-3 else None)


def wrong_order(_: Variant, given: Given) -> Array:
    first, second, third = given["dh_transforms_links"]
    return np.array([second @ first, third @ second @ first])


def by_entries(_: Variant, given: Given) -> Array:
    first, second, third = given["dh_transforms_links"]
    return np.array([first * second, first * second * third])


GENERAL = (
    r"\mathbf T_{i-1}^{i} = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i) = \begin{bmatrix} \cos\theta_i & "
    r"-\sin\theta_i \cos\alpha_i & \sin\theta_i \sin\alpha_i & a_i \cos\theta_i \\ \sin\theta_i & \cos\theta_i "
    r"\cos\alpha_i & -\cos\theta_i \sin\alpha_i & a_i \sin\theta_i \\ 0 & \sin\alpha_i & \cos\alpha_i & d_i \\ "
    r"0 & 0 & 0 & 1 \end{bmatrix}"
)


def explain_first(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            rf"In the standard convention ${GENERAL}$. Row 1 has $\theta_1 = q_1 {v['offset'][0]:+d}°$ and "
            rf"$\alpha_1 = {v['alpha'][0]}°$, so $\cos\alpha_1 = 0$ and $\sin\alpha_1 = {v['alpha'][0] // 90}$:",
            r"\mathbf T_0^1",
            given["dh_transforms_first"].sympy(),
        )
    ]


def explain_links(_: Variant, given: Given) -> list[Step]:
    return [
        Step(
            rf"Put each row into ${GENERAL}$. In a revolute row the joint variable is in $\theta_i$, in a prismatic row it is "
            r"$d_i$. With your numbers:",
            r"\mathbf T_0^1,\; \mathbf T_1^2,\; \mathbf T_2^3",
            numbers=given["dh_transforms_links"],
        )
    ]


def explain_frames(_: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Each factor starts where the one before it ends: $\mathbf T_0^2 = \mathbf T_0^1\,\mathbf T_1^2$ and "
            r"$\mathbf T_0^3 = \mathbf T_0^2\,\mathbf T_2^3$. With your numbers:",
            r"\mathbf T_0^2,\; \mathbf T_0^3",
            numbers=given["dh_transforms_frames"],
        )
    ]


def drawings(v: Variant) -> tuple[Drawing, ...]:
    q = tuple(v[f"{'q' if kind == 'R' else 's'}{i}"] for i, kind in enumerate(v["kinds"], 1))
    slides = str(v["kinds"]).index("P") + 1
    last = frames(v, {"dh_transforms_links": links(v, {})})[-1]
    return (
        Drawing(
            from_standard(rows(v, joints=False), v["kinds"]),
            q,
            f"The arm of your table at your joint values, with frames 0 and 3; the figure writes q{slides} for the stroke "
            f"s{slides}.",
            f"Arm with three joints ({_kinds(v)}), drawn at your joint values.",
            (Triad(np.eye(4), "0"), Triad(last, "3")),
        ),
    )


def statement(v: Variant) -> str:
    order = ORDERS[int(v["order"])]
    header = " | ".join({"theta": r"$\theta_i$", "alpha": r"$\alpha_i$"}.get(name, f"${name}_i$") for name in order)
    body = "\n".join(f"| ${i}$ | " + " | ".join(_cell(v, i, name) for name in order) + " |" for i in (1, 2, 3))
    return rf"""The table of an arm with three joints ({_kinds(v)}) in the **standard** Denavit–Hartenberg convention:

| $i$ | {header} |
|:-:|:-:|:-:|:-:|:-:|
{body}

Mind the order of the columns: it is not the same in every table. From frame $i-1$, turn by $\theta_i$ about its $\mathbf z$ and go $d_i$ along it, then go $a_i$ along the new $\mathbf x$ and
turn by $\alpha_i$ about it: that is frame $i$. Angles of the table are in degrees, the joint angles $q_i$ below in radians; $s_i$ is the
stroke of a prismatic joint. A length may be negative. $\mathbf T_j^i$ is the 4 × 4 pose of frame $i$ in the coordinates of frame $j$."""


def _kinds(v: Variant) -> str:
    names = {"R": "revolute", "P": "prismatic"}
    return ", ".join(f"joint {i} {names[kind]}" for i, kind in enumerate(v["kinds"], 1))


def _cell(v: Variant, i: int, column: str) -> str:
    kind, offset = v["kinds"][i - 1], v["offset"][i - 1]
    if column == "alpha":
        return _degrees(v["alpha"][i - 1])
    if column == "theta":
        if kind == "P":
            return _degrees(offset)
        return f"$q_{i}$" + (f" {'+' if offset > 0 else '−'} {abs(offset)}°" if offset else "")
    if column == "d" and kind == "P":
        return f"$s_{i}$"
    return f"${column}_{i}$" if f"{column}{i}" in v else "0"


def _degrees(angle: int) -> str:
    return f"{'−' if angle < 0 else ''}{abs(angle)}°"


MODIFIED = "The steps of a row seem to be taken in the order of the modified convention; the table is in the standard convention."
EXCHANGED = "The columns a and d seem exchanged; read the labels of the columns."
OFFSET = "The constant angles in the column of theta seem to be left out."
THETA_DEGREES = (
    "The constant angles in the column of theta, printed in degrees, seem to be added to radians as they are."
)
ALPHA_DEGREES = "The angles alpha, printed in degrees, seem to be used as radians."
ALL_DEGREES = "The angles of the table, printed in degrees, seem to be used as radians."
POSE = [["1", "1", "1", "m"]] * 3 + [["1"] * 4]

EXERCISE = Exercise(
    slug="dh_transforms",
    title="From a Denavit–Hartenberg table to transforms",
    source="S2",
    draw=draw,
    statement=statement,
    units={f"q{i}": "rad" for i in (1, 2, 3)} | {f"s{i}": "m" for i in (2, 3)} | dict.fromkeys(LENGTHS, "m"),
    scale=lambda v: float(np.abs(rows(v)[:, 1:3]).sum()),
    objectives=(
        "Turn each row of a Denavit–Hartenberg table into a transform.",
        "Chain the transforms of the links to the poses of all frames.",
    ),
    minutes=35,
    drawings=drawings,
    parts=(
        Part(
            "dh_transforms_first",
            r"The transform $\mathbf T_0^1$ of row 1, as 4 × 4 formulas in `q1`, `a1`, `d1`, with a `*` in every product and angles in "
            "radians (`pi/2` for 90°), such as `2*d1*cos(q1)`; sines and cosines of the right angles may be evaluated",
            3,
            Formulas((4, 4), ("q1", "a1", "d1")),
            lambda v, _: first_link(v),
            hints=(
                "Which two motions of a row are about or along z, which about or along x?",
                "What are sine and cosine of an angle that is shifted by a right angle?",
            ),
            mistakes=(
                Mistake(MODIFIED, first_link_modified),
                Mistake(EXCHANGED, lambda v, _: first_link(v, "d1", "a1")),
                Mistake("The turn by alpha seems to go the other way.", lambda v, _: first_link(v, alpha=-1)),
                Mistake(OFFSET, lambda v, _: first_link(v, offset=False)),
                Mistake(THETA_DEGREES, lambda v, _: first_link_in_degrees(v, alpha=False)),
                Mistake(ALPHA_DEGREES, lambda v, _: first_link_in_degrees(v, theta=False)),
                Mistake(ALL_DEGREES, lambda v, _: first_link_in_degrees(v)),
            ),
            explain=explain_first,
        ),
        Part(
            "dh_transforms_links",
            r"The transforms $\mathbf T_0^1, \mathbf T_1^2, \mathbf T_2^3$ of the three rows at your joint values, stacked to an array "
            "3 × 4 × 4",
            3,
            Numbers((3, 4, 4), [POSE]),
            links,
            hints=("Write one function of theta, d, a, alpha and call it for each row.", "sin and cos take radians."),
            mistakes=(
                Mistake(MODIFIED, lambda v, _: modified_transform(rows(v))),
                Mistake(EXCHANGED, exchanged_lengths),
                Mistake(OFFSET, lambda v, _: standard_transform(rows(v, offsets=False))),
                Mistake(THETA_DEGREES, lambda v, _: links_in_degrees(v, alpha=False)),
                Mistake(ALPHA_DEGREES, lambda v, _: links_in_degrees(v, theta=False)),
                Mistake(ALL_DEGREES, lambda v, _: links_in_degrees(v)),
            ),
            explain=explain_links,
        ),
        Part(
            "dh_transforms_frames",
            r"The poses $\mathbf T_0^2$ and $\mathbf T_0^3$ of frames 2 and 3 in frame 0, stacked to an array 2 × 4 × 4",
            4,
            Numbers((2, 4, 4), [POSE]),
            frames,
            check=unpaid,
            needs=("dh_transforms_links",),
            hints=(
                "Neighbouring indices have to fit: where one factor ends, the next one starts.",
                "Matrix products take @.",
            ),
            mistakes=(
                Mistake(
                    "The factors seem to be poses in frame 0, so that link 1 comes twice; each factor shall start where the one "
                    "before it ends.",
                    literal_chain,
                ),
                Mistake("The transforms of the links seem to be multiplied in the wrong order.", wrong_order),
                Mistake("The matrices seem to be multiplied entry by entry (*); their product takes @.", by_entries),
            ),
            explain=explain_frames,
        ),
    ),
)
