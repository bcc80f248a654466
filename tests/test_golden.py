"""The engine against numbers made with 50-digit arithmetic for 15 arms of the literature."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from kinegrade.solutions.chain import Array, Chain, elementary, from_modified, from_standard
from kinegrade.solutions.expression import parse
from kinegrade.solutions.jacobian import jacobian, last_frame_columns
from kinegrade.solutions.kinematics import forward, frames
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.velocity import joint_rates, twist

GOLDEN: dict[str, dict[str, Any]] = {
    path.stem: json.loads(path.read_text(encoding="utf-8"))
    for path in sorted((Path(__file__).parent / "data" / "golden").glob("*.json"))
}
TWINS = {
    "puma560": "puma560",
    "rrt_offset": "rrt_offset",
    "rrt_spherical": "rrt_spherical",
    "three_axis": "threeaxis",
    "planar_2r": "planar2r",
}
arms = pytest.mark.parametrize("name", GOLDEN)


def chain_of(name: str) -> Chain:
    """T = prod pre_i E_i(q_i + offset_i) tool, with each offset behind its joint."""
    golden = GOLDEN[name]
    pre, kinds = np.array(golden["pre_matrices"], dtype=np.float64), "".join(golden["kinds"])
    behind = [*pre[1:], np.array(golden["tool_matrix"], dtype=np.float64)]
    offsets = [
        elementary("Rz" if kind == "R" else "Tz", offset)
        for kind, offset in zip(kinds, golden["offsets"], strict=True)
    ]
    return Chain(np.stack([pre[0], *(a @ b for a, b in zip(offsets, behind, strict=True))]), kinds)


def column(name: str, key: str) -> Array:
    return np.array([case[key] for case in GOLDEN[name]["cases"]], dtype=np.float64)


def computed(chain: Chain, q: Array) -> dict[str, Array]:
    reached = frames(chain, q)
    return {
        "T": forward(chain, q),
        "jacob0": jacobian(chain, q),
        "jacobe": jacobian(chain, q, "tool"),
        "joint_axes_z": reached[..., :-1, :3, 2],
        "joint_origins": reached[..., :-1, :3, 3],
    }


def test_there_are_fifteen_arms_and_142_configurations():
    assert len(GOLDEN) == 15
    assert sum(len(golden["cases"]) for golden in GOLDEN.values()) == 142


@arms
def test_a_batch_agrees_with_every_golden_number(name: str):
    for key, values in computed(chain_of(name), column(name, "q")).items():
        np.testing.assert_allclose(values, column(name, key), rtol=0, atol=1e-12, err_msg=key)


@arms
def test_a_single_configuration_agrees_with_every_golden_number(name: str):
    chain = chain_of(name)
    for q, case in zip(column(name, "q"), GOLDEN[name]["cases"], strict=True):
        for key, values in computed(chain, q).items():
            np.testing.assert_allclose(values, case[key], rtol=0, atol=1e-12, err_msg=key)


@arms
@pytest.mark.parametrize(("frame", "key"), [("base", "twist0"), ("tool", "twiste")])
def test_twists_agree_with_the_golden_ones(name: str, frame: Any, key: str):
    values = twist(chain_of(name), column(name, "q"), column(name, "qd"), frame)
    np.testing.assert_allclose(values, column(name, key), rtol=0, atol=1e-11)


@arms
def test_the_tool_frame_jacobian_has_the_columns_of_s1_5_26_and_5_27(name: str):
    chain = chain_of(name)
    for q, expected in zip(column(name, "q"), column(name, "jacobe"), strict=True):
        reached = frames(chain, q)
        transforms = np.linalg.inv(reached[:-1]) @ reached[-1]
        np.testing.assert_allclose(
            last_frame_columns(transforms, chain.kinds), expected, rtol=0, atol=1e-12
        )
        np.testing.assert_allclose(
            last_frame_columns(transforms, chain.kinds), jacobian(chain, q, "tool"), atol=1e-12
        )


@pytest.mark.parametrize("name", [name for name, golden in GOLDEN.items() if golden["links"]])
def test_the_printed_table_gives_the_same_chain(name: str):
    golden, rows = GOLDEN[name], list[list[float]]()
    for link in golden["links"]:
        cells = [
            0.0 if link[key] == "q" else float(parse(link[key], ()).at({}))
            for key in ("theta", "d", "a", "alpha")
        ]
        cells[0 if link["kind"] == "R" else 1] += float(parse(link["offset"], ()).at({}))
        rows.append(cells)
    tool = np.eye(4)
    for motion, amount in golden["tool"]:
        tool = tool @ elementary(motion.capitalize(), float(parse(amount, ()).at({})))
    build = from_standard if golden["convention"] == "std" else from_modified
    chain = build(rows, "".join(golden["kinds"]), tool=tool)
    q = column(name, "q")
    np.testing.assert_allclose(forward(chain, q), column(name, "T"), rtol=0, atol=1e-12)
    np.testing.assert_allclose(jacobian(chain, q), column(name, "jacob0"), rtol=0, atol=1e-12)


@pytest.mark.parametrize(("ours", "golden"), TWINS.items())
def test_a_robot_of_the_course_is_its_golden_twin(ours: str, golden: str):
    chain, q = ROBOTS[ours].chain(), column(golden, "q")
    np.testing.assert_allclose(forward(chain, q), column(golden, "T"), rtol=0, atol=1e-12)
    np.testing.assert_allclose(jacobian(chain, q), column(golden, "jacob0"), rtol=0, atol=1e-12)
    np.testing.assert_allclose(
        jacobian(chain, q, "tool"), column(golden, "jacobe"), rtol=0, atol=1e-12
    )


@pytest.mark.parametrize("name", ["puma560", "stanford", "ur5", "panda"])
def test_minimum_norm_rates_of_the_linear_rows_agree_with_the_golden_ones(name: str):
    chain, cases = chain_of(name), GOLDEN[name]["cases"]
    regular = [case for case in cases if min(case["singular_values_linear"]) > 1e-3]
    assert regular
    for case in regular:
        rates = joint_rates(chain, case["q"], (2, 0, 0, 0, 0, 0), slice(0, 3))
        error = 1e-12 / min(case["singular_values_linear"]) ** 2
        np.testing.assert_allclose(rates, case["qd_minnorm_linear_for_v_2x"], rtol=0, atol=error)
