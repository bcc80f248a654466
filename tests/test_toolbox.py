"""Robots of the toolbox, as stand-ins with the attributes of roboticstoolbox-python 1.4.4."""

import json
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from kinegrade.solutions.chain import Array, Chain, elementary, steps_transform
from kinegrade.solutions.expression import parse
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.toolbox import ToolboxError, from_toolbox

GOLDEN = {
    path.stem: json.loads(path.read_text(encoding="utf-8"))
    for path in sorted((Path(__file__).parent / "data" / "golden").glob("*.json"))
}
TABLES = [name for name, golden in GOLDEN.items() if golden["links"]]


@dataclass
class SE3:
    """spatialmath.SE3: the matrix is an attribute."""

    A: Any = field(default_factory=lambda: np.eye(4))


@dataclass
class DHLink:
    """DHLink: sigma 1 for prismatic, mdh 1 for modified; theta is ignored if revolute, d if prismatic."""

    theta: Any = 0.0
    d: Any = 0.0
    a: Any = 0.0
    alpha: Any = 0.0
    offset: float = 0.0
    sigma: int = 0
    mdh: int = 0
    isflip: bool = False


@dataclass
class DHRobot:
    links: list[DHLink]
    base: Any = field(default_factory=SE3)
    tool: Any = field(default_factory=SE3)

    def ets(self) -> Any:
        raise AssertionError("a DHRobot's own ets() has base and tool in it already")


@dataclass
class ET:
    """ET: a transform A() if it is no joint, with the kind "Rz" ... "tx" or "SE3"."""

    kind: str
    T: Array | None = None
    jindex: int | None = None
    isflip: bool = False

    @property
    def isjoint(self) -> bool:
        return self.T is None

    @property
    def axis(self) -> str:
        raise DeprecationWarning("ET.axis is deprecated since 1.4.0, use .kind instead")

    def A(self) -> Array | None:
        return self.T


@dataclass
class ETS:
    data: Sequence[Any]

    def __iter__(self) -> Iterator[Any]:
        return iter(self.data)


@dataclass
class Robot:
    """Robot, once called ERobot: its ets() knows neither base nor tool."""

    elements: ETS
    base: Any = field(default_factory=SE3)
    tool: Any = field(default_factory=SE3)

    def ets(self) -> ETS:
        return self.elements

    @property
    def links(self) -> list[object]:
        return [object()]


def fixed(motion: str, amount: float) -> ET:
    return ET(motion.replace("T", "t"), elementary(motion, amount))


def moving(*kinds: str) -> list[ET]:
    return [ET(kind, jindex=i) for i, kind in enumerate(kinds)]


def table(name: str) -> DHRobot:
    golden, links = GOLDEN[name], list[DHLink]()
    for link in golden["links"]:
        theta, d, a, alpha, offset = (
            0.0 if link[key] == "q" else float(parse(link[key], ()).at({}))
            for key in ("theta", "d", "a", "alpha", "offset")
        )
        links.append(
            DHLink(
                theta,
                d,
                a,
                alpha,
                offset,
                int(link["kind"] == "P"),
                int(golden["convention"] == "mod"),
            )
        )
    tool = steps_transform(
        [(m.capitalize(), float(parse(amount, ()).at({}))) for m, amount in golden["tool"]]
    )
    return DHRobot(links, tool=SE3(tool))


def panda() -> ETS:
    """The toolbox's models.ETS.Panda: tz Rz Rx Rz ..., as `print(panda.ets())` has it."""
    half, joints = np.pi / 2, moving(*["Rz"] * 7)
    between = [
        [("Tz", 0.333)], [("Rx", -half)], [("Rx", half), ("Tz", 0.316)], [("Tx", 0.0825), ("Rx", half)],
        [("Tx", -0.0825), ("Rx", -half), ("Tz", 0.384)], [("Rx", half)], [("Tx", 0.088), ("Rx", half), ("Tz", 0.107)],
    ]  # fmt: skip
    elements = [
        e
        for steps, joint in zip(between, joints, strict=True)
        for e in (*(fixed(*s) for s in steps), joint)
    ]
    return ETS([*elements, fixed("Tz", 0.103), fixed("Rz", -np.pi / 4)])


def same_motion(one: Chain, other: Chain) -> None:
    assert one.kinds == other.kinds
    q = np.random.default_rng(8).uniform(-2, 2, (8, one.n))
    np.testing.assert_allclose(forward(one, q), forward(other, q), rtol=0, atol=1e-14)
    np.testing.assert_allclose(jacobian(one, q), jacobian(other, q), rtol=0, atol=1e-14)


@pytest.mark.parametrize("name", TABLES)
def test_a_dh_robot_is_its_golden_twin(name: str):
    chain, cases = from_toolbox(table(name)), GOLDEN[name]["cases"]
    q = [case["q"] for case in cases]
    np.testing.assert_allclose(forward(chain, q), [case["T"] for case in cases], rtol=0, atol=1e-12)
    np.testing.assert_allclose(
        jacobian(chain, q), [case["jacob0"] for case in cases], rtol=0, atol=1e-12
    )


@pytest.mark.parametrize("name", ["puma560", "stanford", "ur5", "panda"])
def test_a_dh_robot_is_the_robot_of_the_catalogue(name: str):
    same_motion(from_toolbox(table(name)), ROBOTS[name].chain())


def test_an_elementary_transform_sequence_is_the_same_panda():
    same_motion(from_toolbox(panda()), ROBOTS["panda"].chain())
    same_motion(from_toolbox(Robot(panda())), ROBOTS["panda"].chain())


@pytest.mark.parametrize("robot", [table("puma560"), Robot(panda())], ids=["DHRobot", "Robot"])
def test_base_and_tool_stand_before_and_behind(robot: Any):
    base = steps_transform([("Tx", 1.0), ("Rx", 0.3)])
    tool = steps_transform([("Tz", 0.2), ("Ry", 0.4)])
    bare = from_toolbox(replace(robot, tool=SE3()))
    dressed = from_toolbox(replace(robot, base=SE3(base), tool=tool))
    q = np.linspace(0.1, 0.9, bare.n)
    np.testing.assert_allclose(
        forward(dressed, q), base @ forward(bare, q) @ tool, rtol=0, atol=1e-14
    )
    same_motion(from_toolbox(replace(robot, base=None, tool=None)), bare)


@pytest.mark.parametrize("mdh", [0, 1])
@pytest.mark.parametrize("sigma", [0, 1])
def test_offsets_are_added_and_what_q_replaces_is_ignored(mdh: int, sigma: int):
    given = dict.fromkeys(("d", "theta")[sigma : sigma + 1], 0.4)
    ignored = {**given, ("theta", "d")[sigma]: 9.0}
    link = DHLink(a=0.3, alpha=0.5, offset=0.7, sigma=sigma, mdh=mdh, **ignored)
    before, behind = [("Tx", 0.3), ("Rx", 0.5)], [("Tx", 0.3), ("Rx", 0.5)]
    turn, lift = (0.4, 1.2) if sigma else (1.2, 0.4)
    row = [("Rz", turn), ("Tz", lift)]
    expected = steps_transform([*before, *row] if mdh else [*row, *behind])
    np.testing.assert_allclose(
        forward(from_toolbox(DHRobot([link])), [0.5]), expected, rtol=0, atol=1e-15
    )


@pytest.mark.parametrize("sigma", [0, 1])
@pytest.mark.parametrize("mdh", [0, 1])
def test_a_flipped_joint_moves_backwards_from_its_offset(sigma: int, mdh: int):
    link = DHLink(theta=0.2, d=0.4, a=0.3, alpha=0.5, offset=0.7, sigma=sigma, mdh=mdh)
    plain, flipped = (from_toolbox(DHRobot([link, replace(link, isflip=f)])) for f in (False, True))
    np.testing.assert_allclose(
        forward(flipped, [0.3, 0.6]), forward(plain, [0.3, -0.6]), rtol=0, atol=1e-15
    )
    J, mirrored = jacobian(flipped, [0.3, 0.6]), jacobian(plain, [0.3, -0.6]) * (1, -1)
    np.testing.assert_allclose(J, mirrored, rtol=0, atol=1e-15)


@pytest.mark.parametrize("kind", ["Rx", "Ry", "Rz", "tx", "ty", "tz"])
@pytest.mark.parametrize("isflip", [False, True])
def test_an_element_moves_about_or_along_its_axis(kind: str, isflip: bool):
    link = fixed("Tx", 0.5)
    T = forward(from_toolbox(ETS([link, ET(kind, jindex=0, isflip=isflip), link])), [0.7])
    expected = link.T @ elementary(kind.replace("t", "T"), -0.7 if isflip else 0.7) @ link.T
    np.testing.assert_allclose(T, expected, rtol=0, atol=1e-15)


def test_elements_without_a_kind_have_an_axis():
    @dataclass
    class Older:
        axis: str
        isjoint: bool = True

        def A(self) -> None: ...

    assert from_toolbox(ETS([Older("Rx"), Older("tz")])).kinds == "RP"


def test_the_joints_of_a_branch_keep_their_numbers():
    assert from_toolbox(ETS([ET("Rz", jindex=3), ET("ty", jindex=5)])).kinds == "RP"


@pytest.mark.parametrize(
    ("robot", "sentence"),
    [
        (3, "takes a DHRobot, a Robot or an ETS of roboticstoolbox, got an object of type int"),
        ("puma560", "got an object of type str"),
        (None, "got an object of type NoneType"),
        (DHRobot([]), "takes a robot with joints, got none that moves"),
        ([1, 2], "an ETS takes elementary transforms, got an object of type int"),
        (ETS([]), "takes a robot with joints, got none that moves"),
        (ETS([fixed("Tx", 1.0)]), "takes a robot with joints, got none that moves"),
        (
            ETS([ET("Rz", jindex=1), ET("Rz", jindex=0)]),
            r"numbered in the order in which they stand, got \[1, 0\]",
        ),
        (ETS([ET("R", jindex=0)]), "a joint takes one of Rx, Ry, Rz, tx, ty, tz, got R"),
        (
            ETS([ET("SE2", np.eye(3)), ET("Rz")]),
            r"takes one transform of shape \(4, 4\) in numbers, got .* \(3, 3\)",
        ),
        (DHRobot([DHLink(a=[1])]), r"a row takes a number for a, got \[1\]"),
        (DHRobot([DHLink(d="d1")]), "a row takes a number for d, got 'd1'"),
        (
            DHRobot([DHLink()], base=SE3([np.eye(4)] * 2)),
            r"the base takes one transform of shape \(4, 4\)",
        ),
        (DHRobot([DHLink()], tool=SE3(np.full((4, 4), np.nan))), "the tool takes one transform"),
    ],
)
def test_what_is_no_chain_is_refused_with_a_sentence(robot: Any, sentence: str):
    with pytest.raises(ToolboxError, match=sentence):
        from_toolbox(robot)


def test_the_toolbox_is_not_imported():
    code = (
        "import sys; import kinegrade.solutions.toolbox; sys.exit('roboticstoolbox' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
