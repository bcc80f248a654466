"""The planar arm: formulas against transforms and differences, what the source prints, follow-through."""

import numpy as np
import pytest
from answers import EXERCISES, raws, right_raws, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.expression_array import expression_array
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward

EXERCISE = EXERCISES["planar_2r"]
SEEDS = range(12)
PRINTED = ["l1*cos(q1) + l2*cos(q1 + q2)", "l1*sin(q1) + l2*sin(q1 + q2)", "q1 + q2"]
PRINTED_J = [
    ["-l1*sin(q1) - l2*sin(q1 + q2)", "-l2*sin(q1 + q2)"],
    ["l1*cos(q1) + l2*cos(q1 + q2)", "l2*cos(q1 + q2)"],
    ["1", "1"],
]


def own_numbers(v, q):
    return {name: v[name] for name in ("l1", "l2", "beta")} | {"q1": q[0], "q2": q[1]}


def verdicts_of(v, answers):
    right = right_raws(EXERCISE, v)
    return {verdict.part: verdict for verdict in mark(EXERCISE, v, right | raws(answers))}


@pytest.mark.parametrize("seed", SEEDS)
def test_formulas_and_transforms_tell_the_same_pose_and_jacobian(seed):
    v = variant_of("planar_2r", seed)
    got = references(EXERCISE, v)
    T, J, values = got["planar_2r_T"][-1], got["planar_2r_J"], own_numbers(v, v["q"])
    x, y, theta = got["planar_2r_pose"].at(values)
    np.testing.assert_allclose(
        [x, y, np.cos(theta), np.sin(theta)], [*T[:2, 3], *T[:2, 0]], atol=1e-12
    )
    np.testing.assert_allclose(got["planar_2r_J_symbolic"].at(values), J[[0, 1, 5]], atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_jacobian_agrees_with_differences_of_the_pose(seed):
    v = variant_of("planar_2r", seed)
    got = references(EXERCISE, v)
    pose, h = got["planar_2r_pose"], 1e-6
    steps = [np.array(v["q"]) + h * np.array(step) for step in ((1, 0), (-1, 0), (0, 1), (0, -1))]
    a, b, c, d = (pose.at(own_numbers(v, q)) for q in steps)
    np.testing.assert_allclose(
        got["planar_2r_J"][[0, 1, 5]], np.array([a - b, c - d]).T / (2 * h), atol=1e-8
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_the_drawn_arm_is_the_arm_of_the_question(seed):
    v = variant_of("planar_2r", seed)
    got = references(EXERCISE, v)
    chain = EXERCISE.drawings(v)[1].chain
    np.testing.assert_allclose(jacobian(chain, v["q"]), got["planar_2r_J"], atol=1e-12)
    np.testing.assert_allclose(
        forward(chain, v["q"])[:3, 3], got["planar_2r_T"][-1, :3, 3], atol=1e-12
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_the_arm_is_bent(seed):
    v = variant_of("planar_2r", seed)
    T = references(EXERCISE, v)["planar_2r_T"]
    assert abs(np.sin(v["q"][1])) > 0.3
    assert abs((np.linalg.inv(T[0]) @ T[1])[1, 0]) > 0.3


@pytest.mark.parametrize("seed", SEEDS)
def test_what_the_source_prints_earns_nothing(seed):
    verdicts = verdicts_of(
        variant_of("planar_2r", seed),
        {"planar_2r_pose": PRINTED, "planar_2r_J_symbolic": [["0", "0"]] * 3},
    )
    assert verdicts["planar_2r_pose"].points == 0
    assert any("positive senses" in finding.text for finding in verdicts["planar_2r_pose"].findings)
    together = verdicts_of(
        variant_of("planar_2r", seed),
        {"planar_2r_pose": PRINTED, "planar_2r_J_symbolic": PRINTED_J},
    )
    assert together["planar_2r_J_symbolic"].points == 0
    alone = verdicts_of(variant_of("planar_2r", seed), {"planar_2r_J_symbolic": PRINTED_J})
    assert alone["planar_2r_J_symbolic"].points == 0


def test_a_product_in_the_wrong_order_is_not_paid_for_its_rotation():
    v = variant_of("planar_2r", 0)
    T1, T2 = references(EXERCISE, v)["planar_2r_T"]
    verdict = verdicts_of(v, {"planar_2r_T": np.array([T1, np.linalg.inv(T1) @ T2 @ T1])})[
        "planar_2r_T"
    ]
    assert verdict.points == verdict.out_of / 2
    assert "wrong order" in verdict.findings[0].text


def test_derivatives_of_a_wrong_pose_are_followed_through():
    v = variant_of("planar_2r", 0)
    part = EXERCISE.asked[0]
    wrong = {"planar_2r_pose": part.mistakes[0].solve(v, {})}
    given = {"planar_2r_pose": formulas(wrong["planar_2r_pose"])}
    J = EXERCISE.asked[1].solve(v, given)
    verdicts = verdicts_of(
        v, wrong | {"planar_2r_J_symbolic": [[str(x) for x in row] for row in J.tolist()]}
    )
    assert verdicts["planar_2r_pose"].status != "correct"
    assert verdicts["planar_2r_J_symbolic"].points == EXERCISE.asked[1].points


def formulas(texts):
    return expression_array(texts, ("l1", "l2", "beta", "q1", "q2"))


def test_nothing_follows_from_a_pose_that_is_made_easy():
    v = variant_of("planar_2r", 0)
    theta = str(references(EXERCISE, v)["planar_2r_pose"].entries[2])
    J = references(EXERCISE, v)["planar_2r_J_symbolic"].text()[2]
    easy = {
        "planar_2r_pose": ["0", "0", theta],
        "planar_2r_J_symbolic": [["0", "0"], ["0", "0"], J],
    }
    verdicts = verdicts_of(v, easy)
    assert verdicts["planar_2r_pose"].status == "partly"
    assert verdicts["planar_2r_J_symbolic"].points == 0


def test_numbers_put_into_the_formulas_earn_nothing():
    v = variant_of("planar_2r", 0)
    pose = references(EXERCISE, v)["planar_2r_pose"].at(own_numbers(v, v["q"]))
    verdicts = verdicts_of(v, {"planar_2r_pose": Raw("num", pose)})
    assert verdicts["planar_2r_pose"].points == 0


@pytest.mark.parametrize(
    ("signs", "words"),
    [
        (lambda _: [[-1, -1], [1, 1], [1, 1]], "derivative of the cosine"),
        (lambda J: [[int(entry) for entry in J[2]]] * 3, "chain rule"),
    ],
)
def test_wrong_signs_in_the_derivatives_are_named(signs, words):
    for seed in SEEDS:
        v = variant_of("planar_2r", seed)
        J = references(EXERCISE, v)["planar_2r_J_symbolic"].text()
        wrong = [
            [f"{s}*({entry})" for s, entry in zip(*rows, strict=True)]
            for rows in zip(signs(J), J, strict=True)
        ]
        (finding,) = verdicts_of(v, {"planar_2r_J_symbolic": wrong})[
            "planar_2r_J_symbolic"
        ].findings
        assert words in finding.text or finding.text == "Every sign is reversed."


def turned(angle, size):
    """Turn by an angle, then go along the link."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, size * c], [s, c, 0, size * s], [0, 0, 1, 0], [0, 0, 0, 1]])


def misread(v, senses, offset):
    """The whole sheet of somebody who reads other senses, or another angle of link 2 at q2 = 0 [deg]."""
    one, two = senses
    first = f"beta + {one}*q1"
    second = f"{first} + {two}*q2 + {offset}*pi/180"
    x, y = (f"l1*{turn}({first}) + l2*{turn}({second})" for turn in ("cos", "sin"))
    dx, dy = f"l2*sin({second})", f"l2*cos({second})"
    T1 = turned(v["beta"] + one * v["q"][0], v["l1"])
    T2 = T1 @ turned(two * v["q"][1] + np.radians(offset), v["l2"])
    r1, r2 = T2[:2, 3], T2[:2, 3] - T1[:2, 3]
    return {
        "planar_2r_pose": [x, y, second],
        "planar_2r_J_symbolic": [
            [f"-{one}*({y})", f"-{two}*{dx}"],
            [f"{one}*({x})", f"{two}*{dy}"],
            [str(one), str(two)],
        ],
        "planar_2r_T": np.array([T1, T2]),
        "planar_2r_J": np.array(
            [[-one * r1[1], one * r1[0], 0, 0, 0, one], [-two * r2[1], two * r2[0], 0, 0, 0, two]]
        ).T,
    }


def form_of(v):
    """Senses and offset [deg], read off the printed text."""
    said = EXERCISE.statement(v)
    senses = [
        1 if f"Positive $q_{i}$ turns link {i} **counter-clockwise**" in said else -1
        for i in (1, 2)
    ]
    offset = 0 if "points the way link 1 points" in said else -90 if "90° clockwise" in said else 90
    return senses, offset


@pytest.mark.parametrize("seed", SEEDS)
def test_a_sheet_worked_from_the_text_alone_is_right(seed):
    v = variant_of("planar_2r", seed)
    verdicts = mark(EXERCISE, v, raws(misread(v, *form_of(v))))
    assert [verdict.points for verdict in verdicts] == [part.points for part in EXERCISE.asked]


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("part", [part.variable for part in EXERCISE.asked])
def test_joints_that_all_count_counter_clockwise_are_named_in_every_part(part, seed):
    v = variant_of("planar_2r", seed)
    wrong = misread(v, (1, 1), form_of(v)[1])
    verdict = verdicts_of(v, {part: wrong[part]})[part]
    assert verdict.status != "correct"
    assert any("look again at the positive senses" in finding.text for finding in verdict.findings)


@pytest.mark.parametrize("part", [part.variable for part in EXERCISE.asked])
def test_a_missing_right_angle_between_the_links_is_named_in_every_part(part):
    for seed in SEEDS:
        v = variant_of("planar_2r", seed)
        senses, offset = form_of(v)
        verdict = verdicts_of(v, {part: misread(v, senses, 0 if offset else 90)[part]})[part]
        assert verdict.status != "correct"
        assert any("how link 2 stands to link 1" in finding.text for finding in verdict.findings)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    "read",
    [
        lambda _, offset: ((1, 1), offset),
        lambda senses, offset: ((-senses[0], senses[1]), offset),
        lambda senses, offset: (senses, -offset or 90),
    ],
)
def test_both_jacobians_of_a_misread_arm_follow_from_its_pose_and_transforms(read, seed):
    v = variant_of("planar_2r", seed)
    wrong = misread(v, *read(*form_of(v)))
    pose, symbolic, T, J = mark(
        EXERCISE, v, raws(wrong | {name: np.round(wrong[name], 4) for name in list(wrong)[2:]})
    )
    assert "correct" not in (pose.status, T.status)
    assert (symbolic.points, J.points) == (symbolic.out_of, J.out_of)
    assert all("follows from your own" in verdict.findings[-1].text for verdict in (symbolic, J))


def test_the_jacobian_of_a_misread_arm_does_not_follow_from_the_right_transforms():
    v = next(
        v for v in (variant_of("planar_2r", seed) for seed in SEEDS) if form_of(v)[0] == [-1, -1]
    )
    J = misread(v, (1, 1), form_of(v)[1])["planar_2r_J"]
    assert verdicts_of(v, {"planar_2r_J": J})["planar_2r_J"].points == 1.5


@pytest.mark.parametrize(("more", "status"), [(2, "correct"), (-4, "correct"), (1, "partly")])
def test_theta_may_differ_by_full_turns(more, status):
    v = variant_of("planar_2r", 0)
    x, y, theta = references(EXERCISE, v)["planar_2r_pose"].text()
    assert (
        verdicts_of(v, {"planar_2r_pose": [x, y, f"{theta} + {more}*pi"]})["planar_2r_pose"].status
        == status
    )
    assert (
        verdicts_of(v, {"planar_2r_pose": ["0", y, f"{theta} + {more}*pi"]})[
            "planar_2r_pose"
        ].status
        == "partly"
    )


@pytest.mark.parametrize(("columns", "share"), [((0,), 0.8), ((1,), 0.8), ((0, 1), 0.6)])
def test_a_wrong_sign_of_omega_costs_a_share_and_leaves_the_linear_rows(columns, share):
    for seed in SEEDS:
        v = variant_of("planar_2r", seed)
        got = references(EXERCISE, v)
        J, symbolic = got["planar_2r_J"].copy(), got["planar_2r_J_symbolic"].text()
        for column in columns:
            J[5, column] *= -1
            symbolic[2][column] = f"-({symbolic[2][column]})"
        verdicts = verdicts_of(v, {"planar_2r_J": J, "planar_2r_J_symbolic": symbolic})
        for name in ("planar_2r_J", "planar_2r_J_symbolic"):
            assert verdicts[name].points == pytest.approx(share * verdicts[name].out_of)
            assert verdicts[name].findings
