"""Which tables are taken for the drawn arm: `python benchmarks/dh_tables.py [--seed N]`.

Twelve arms in both conventions. Their frames are placed otherwise, as far as a sheet leaves that
open, and every such table has to be accepted; random edits that make another arm of it have to be
refused, which forward kinematics alone says here; and single mistakes have to be named by row and
column.
"""

import argparse
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise, product
from math import pi
from typing import Any

import numpy as np
from kinegrade.exercises.answers import TableOf
from kinegrade.grader.kinds.repairs import repairs
from kinegrade.grader.kinds.same_arm import describes_same_arm
from kinegrade.solutions.chain import from_modified, from_standard
from kinegrade.solutions.equivalence import Given
from kinegrade.solutions.kinematics import frames
from kinegrade.solutions.random_chain import random_chain
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.table import COLUMNS, Table, read_table

LEGITIMATE, WRONG = 1056, 1500
SHOWS = 0.02  # [rad, m] by which a wrong table is another arm: far more than three decimals
THETA, D, A, ALPHA = range(4)
POLICIES = {
    "all given": Given(),
    "senses free": Given(senses=False),
    "zero free": Given(zero=False, senses=False),
    "all free": Given(base=False, tool=False, senses=False, zero=False),
}
NAMED = (
    "planar_2r",
    "three_axis",
    "rrt_offset",
    "rpp_cylindrical",
    "scara",
    "stanford",
    "articulated_6r",
    "puma560",
)
RANDOM = {"PRR": 1, "PPP": 2, "RRR": 3, "RRRRRR": 4}


@dataclass(frozen=True)
class Sheet:
    """What is asked of an arm: rows (n, 4) of the reference, and what the sheet gives of it."""

    name: str
    policy: str
    answer: TableOf
    rows: np.ndarray

    @property
    def chain(self) -> Any:
        """The drawn arm."""
        return built(self.rows, self.answer.kinds, self.answer.convention)

    @property
    def given(self) -> Given:
        """What a table has to agree with."""
        return self.answer.given


def built(rows: np.ndarray, kinds: str, convention: str) -> Any:
    """The chain of a table."""
    build = from_modified if convention == "modified" else from_standard
    return build(rows, kinds)


def table_of(rows: np.ndarray, kinds: str, convention: Any) -> Table:
    """A table of numbers as a student types it."""
    cells: list[list[str]] = []
    for i, (row, kind) in enumerate(zip(rows.tolist(), kinds, strict=True), 1):
        typed = [repr(number) for number in row]
        place = THETA if kind == "R" else D
        typed[place] = f"q{i} + ({typed[place]})"
        cells.append(typed)
    return read_table(cells, [f"q{i}" for i in range(1, len(kinds) + 1)], convention)


def sheets(rng: np.random.Generator) -> Iterator[Sheet]:
    """Every arm in both conventions under every policy."""
    arms: dict[str, Any] = {}
    for name in NAMED:
        lengths = {one: round(rng.uniform(0.2, 0.9), 3) for one in ROBOTS[name].parameters}
        arms[name] = ROBOTS[name].chain(lengths)
    for kinds, seed in RANDOM.items():
        arms[f"oblique {kinds}"] = random_chain(kinds, np.random.default_rng(seed))
    for (name, chain), convention in product(arms.items(), ("standard", "modified")):
        free = Given(base=False, tool=False)
        rows = placed_otherwise(chain, free, rng, convention)
        for policy, given in POLICIES.items():
            answer = TableOf((), chain.kinds, convention, 3, given)  # type: ignore[arg-type]
            yield Sheet(name, policy, answer, rows)


def placed_otherwise(
    chain: Any, given: Given, rng: np.random.Generator, convention: str
) -> np.ndarray:
    """Rows of another table of the arm, with everything chosen that is not given."""
    n, turns = chain.n, np.array(list(chain.kinds)) == "R"
    home = np.where(turns, rng.uniform(-3, 3, n), rng.uniform(-0.5, 0.5, n))
    if given.zero:
        home = np.zeros(n)
    axes = frames(chain, home)
    base, tool = np.eye(4), axes[-1]
    signs = rng.choice([-1.0, 1.0], n)
    if given.senses:
        signs = np.ones(n)
    if given.base and convention == "standard":
        signs[0] = 1.0
    if given.tool and convention == "modified":
        signs[-1] = 1.0
    z = [sign * axis[:3, 2] for sign, axis in zip(signs, axes[:-1], strict=True)]
    p = [axis[:3, 3].copy() for axis in axes[:-1]]
    _slide_axes(chain.kinds, p, base, tool, given, rng)
    placed = _placed(z, p, base, tool, given, rng, convention)
    rows = np.array([row_between(*pair, convention) for pair in pairwise(placed)])
    return np.round(rows, 12) + 0.0


def _slide_axes(kinds: str, p: Any, base: Any, tool: Any, given: Given, rng: Any) -> None:
    """A slide has no place; at a given frame it may move along the x axis alone."""
    for i, kind in enumerate(kinds):
        if kind == "R":
            continue
        by = rng.normal(0, 0.5, 3)
        if i == 0 and given.base:
            by = base[:3, 0] * 0.0
        elif i == len(kinds) - 1 and given.tool:
            by = tool[:3, 0] * 0.0
        p[i] = p[i] + by


def _placed(
    z: Any, p: Any, base: Any, tool: Any, given: Given, rng: Any, convention: str
) -> list[np.ndarray]:
    """Frames 0 to n that such a convention allows."""
    normals = [common_normal(*z_p, *other, rng) for z_p, other in pairwise(zip(z, p, strict=True))]
    first, last = base, tool
    if not given.base:
        first = frame(across(z[0], rng), z[0], p[0] + rng.uniform(-1, 1) * z[0])
    if convention == "standard":
        inner = [frame(x, z[i + 1], foot) for i, (x, _, foot) in enumerate(normals)]
    else:
        inner = [frame(x, z[i], foot) for i, (x, foot, _) in enumerate(normals)]
    if not given.tool:
        along = z[-1]
        if convention == "standard" and not given.senses:
            along = along * rng.choice([-1, 1])
        last = frame(across(z[-1], rng), along, p[-1] + rng.uniform(-1, 1) * z[-1])
    return [first, *inner, last]


def frame(x: Any, z: Any, origin: Any) -> np.ndarray:
    result = np.eye(4)
    result[:3, 0], result[:3, 1], result[:3, 2], result[:3, 3] = x, np.cross(z, x), z, origin
    return result


def across(z: Any, rng: np.random.Generator) -> np.ndarray:
    x = np.cross(z, rng.normal(size=3))
    return x / np.linalg.norm(x)


def common_normal(z: Any, p: Any, other_z: Any, other_p: Any, rng: Any) -> tuple[Any, Any, Any]:
    """Direction of the common normal of two axes, either way along it, and its feet on both."""
    normal, between = np.cross(z, other_z), other_p - p
    if np.linalg.norm(normal) > 1e-9:
        x = normal / np.linalg.norm(normal) * rng.choice([-1, 1])
        along = np.linalg.solve(np.column_stack([z, -other_z, x]), between)
        return x, p + along[0] * z, other_p + along[1] * other_z
    apart = between - (between @ z) * z
    foot = p + rng.uniform(-1, 1) * z
    if np.linalg.norm(apart) > 1e-9:
        return apart / np.linalg.norm(apart) * rng.choice([-1, 1]), foot, foot + apart
    return across(z, rng), foot, foot


def row_between(a: np.ndarray, b: np.ndarray, convention: str) -> tuple[Any, ...]:
    """theta, d, a, alpha that lead from one frame to the next."""
    T = np.linalg.inv(a) @ b
    if convention == "standard":
        theta, alpha = np.arctan2(T[1, 0], T[0, 0]), np.arctan2(T[2, 1], T[2, 2])
        x = np.array([np.cos(theta), np.sin(theta), 0])
        return theta, T[2, 3], x @ T[:3, 3], alpha
    theta, alpha = np.arctan2(-T[0, 1], T[0, 0]), np.arctan2(-T[1, 2], T[2, 2])
    return theta, T[1:3, 3] @ [-np.sin(alpha), np.cos(alpha)], T[0, 3], alpha


# The oracle: products of matrices written out here, and nothing of the engine.


def link(row: Any, convention: str) -> np.ndarray:
    """The transform of one row, by the book."""
    theta, d, a, alpha = row
    ct, st, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    if convention == "standard":
        top = [[ct, -st * ca, st * sa, a * ct], [st, ct * ca, -ct * sa, a * st], [0, sa, ca, d]]
    else:
        top = [
            [ct, -st, 0, a],
            [st * ca, ct * ca, -sa, -sa * d],
            [st * sa, ct * sa, ca, ca * d],
        ]
    return np.array([*top, [0, 0, 0, 1]])


def hand(rows: np.ndarray, kinds: str, convention: str, q: np.ndarray) -> np.ndarray:
    """The pose of the last frame."""
    T = np.eye(4)
    for row, kind, joint in zip(rows, kinds, q, strict=True):
        moved = np.array(row)
        moved[THETA if kind == "R" else D] += joint
        T = T @ link(moved, convention)
    return T


def is_another_arm(sheet: Sheet, rows: np.ndarray) -> bool | None:
    """Whether a table describes another arm; None where this oracle cannot tell."""
    if not (sheet.given.base and sheet.given.tool and sheet.given.zero):
        return True if other_invariants(sheet, rows) else None
    kinds, convention = sheet.answer.kinds, sheet.answer.convention
    rng = np.random.default_rng(7)
    Q = rng.uniform(-2, 2, (3, len(kinds)))
    wanted = [hand(sheet.rows, kinds, convention, q) for q in Q]
    senses = [(1.0, 1.0 if sheet.given.senses else -1.0)] * len(kinds)
    nearest = np.inf
    for signs in {*product(*senses)}:
        off = 0.0
        for q, T in zip(Q, wanted, strict=True):
            off = max(off, np.abs(hand(rows, kinds, convention, np.array(signs) * q) - T).max())
            if off > nearest:
                break
        nearest = min(nearest, off)
    if SHOWS > nearest > SHOWS / 10:
        return None
    return bool(nearest > SHOWS)


def other_invariants(sheet: Sheet, rows: np.ndarray) -> bool:
    """Whether neighbouring axes have another angle or distance, which no placing of frames mends.

    The distance counts between turning joints: a slide has no place.
    """
    kinds = sheet.answer.kinds
    inner = slice(0, -1)
    if sheet.answer.convention == "modified":
        inner = slice(1, None)
    angles = [np.abs(np.cos(some[inner, ALPHA])) for some in (sheet.rows, rows)]
    turning = np.array([a + b == "RR" for a, b in pairwise(kinds)])
    apart = [np.abs(some[inner, A]) for some in (sheet.rows, rows)]
    differs = np.abs(angles[0] - angles[1]) > SHOWS
    farther = (np.abs(apart[0] - apart[1]) > SHOWS) & turning
    return bool((differs | farther).any())


# Wrong tables, and single mistakes that have a name.


def random_edit(sheet: Sheet, rows: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """One or two cells changed, each in one of the ways in which cells go wrong."""
    edited = rows.copy()
    for _ in range(rng.integers(1, 3)):
        i, column = rng.integers(len(rows)), rng.integers(4)
        value = edited[i, column]
        if column in (THETA, ALPHA):
            changes = [-value, value + pi / 2, value - pi / 2, value + pi, value + 0.3, 0.0]
        else:
            changes = [-value, 0.0, value + rng.uniform(0.05, 0.5), rng.uniform(-1, 1)]
        edited[i, column] = rng.choice(changes)
    return edited


Edit = Callable[[np.ndarray, int, np.random.Generator], tuple[np.ndarray, str]]


def cell(column: int, change: Callable[[float, np.random.Generator], float]) -> Edit:
    def edit(rows: np.ndarray, i: int, rng: np.random.Generator) -> tuple[np.ndarray, str]:
        edited = rows.copy()
        edited[i, column] = change(rows[i, column], rng)
        return edited, f"Row {i + 1}: {COLUMNS[column]} "

    return edit


def exchanged(rows: np.ndarray, i: int, _: np.random.Generator) -> tuple[np.ndarray, str]:
    edited = rows.copy()
    edited[i, [D, A]] = rows[i, [A, D]]
    return edited, f"Row {i + 1}: a and d "


def longer(value: float, rng: np.random.Generator) -> float:
    return value + rng.choice([-1, 1]) * rng.uniform(0.1, 0.4)


SINGLE: dict[str, Edit] = {
    "sign of alpha": cell(ALPHA, lambda value, _: -value),
    "wrong alpha": cell(ALPHA, lambda value, rng: value + rng.uniform(0.3, 1.2)),
    "90 degrees for -90": cell(ALPHA, lambda value, _: -value if abs(value) > 1 else value),
    "alpha 0 for 90": cell(ALPHA, lambda value, _: value - pi / 2),
    "alpha in degrees": cell(ALPHA, lambda value, _: float(np.degrees(value))),
    "offset in degrees": cell(THETA, lambda value, _: float(np.degrees(value))),
    "missing offset": cell(THETA, lambda *_: 0.0),
    "sign of an offset": cell(THETA, lambda value, _: -value),
    "forgotten a": cell(A, lambda *_: 0.0),
    "forgotten d": cell(D, lambda *_: 0.0),
    "wrong a": cell(A, longer),
    "wrong d": cell(D, longer),
    "sign of a": cell(A, lambda value, _: -value),
    "sign of d": cell(D, lambda value, _: -value),
    "a and d exchanged": exchanged,
}


@dataclass
class Tally:
    """Counts of one kind of table, and how long they took [ms]."""

    count: int = 0
    good: int = 0
    alone: int = 0  # named by one sentence only


def timed(function: Callable[[], Any], times: list[float]) -> Any:
    start = time.process_time()
    result = function()
    times.append(1e3 * (time.process_time() - start))
    return result


def accepted(sheet: Sheet, rows: np.ndarray, times: list[float]) -> bool:
    reference = table_of(sheet.rows, sheet.answer.kinds, sheet.answer.convention)
    own = table_of(np.round(rows, 4), sheet.answer.kinds, sheet.answer.convention)
    return timed(lambda: describes_same_arm(sheet.answer, {}, reference, own), times)


def told(
    sheet: Sheet, rows: np.ndarray, times: list[float], convention: str | None = None
) -> list[str]:
    reference = table_of(sheet.rows, sheet.answer.kinds, sheet.answer.convention)
    own = table_of(np.round(rows, 4), sheet.answer.kinds, sheet.answer.convention)
    found = timed(lambda: repairs(sheet.answer, {}, reference, own), times)
    return [named.sentence for named in found]


def legitimate(all_sheets: list[Sheet], rng: np.random.Generator, times: list[float]) -> Any:
    """Accepted tables of every policy."""
    tallies: dict[str, Tally] = defaultdict(Tally)
    for i in range(LEGITIMATE):
        sheet = all_sheets[i % len(all_sheets)]
        rows = placed_otherwise(sheet.chain, sheet.given, rng, sheet.answer.convention)
        tally = tallies[f"legitimate, {sheet.policy}"]
        tally.count += 1
        tally.good += accepted(sheet, rows, times)
    return tallies


def wrong(all_sheets: list[Sheet], rng: np.random.Generator, times: list[float]) -> Any:
    """Refused tables of every policy; what is the same arm after all has to be accepted."""
    tallies: dict[str, Tally] = defaultdict(Tally)
    tries = 0
    while sum(tally.count for name, tally in tallies.items() if "wrong" in name) < WRONG:
        sheet = all_sheets[tries % len(all_sheets)]
        tries += 1
        rows = placed_otherwise(sheet.chain, sheet.given, rng, sheet.answer.convention)
        edited = random_edit(sheet, rows, rng)
        another = is_another_arm(sheet, edited)
        if another is None:
            continue
        what = "wrong" if another else "edited and the same arm"
        tally = tallies[f"{what}, {sheet.policy}"]
        tally.count += 1
        tally.good += accepted(sheet, edited, times) is not another
    return tallies


def singles(all_sheets: list[Sheet], rng: np.random.Generator, times: list[float]) -> Any:
    """Single mistakes in tables with frames placed otherwise, found with row and column."""
    tallies: dict[str, Tally] = defaultdict(Tally)
    for (name, edit), sheet in product(SINGLE.items(), all_sheets):
        rows = placed_otherwise(sheet.chain, sheet.given, rng, sheet.answer.convention)
        for i in range(len(rows)):
            edited, place = edit(rows, i, rng)
            if not is_another_arm(sheet, edited):
                continue
            said = told(sheet, edited, times)
            tally = tallies[name]
            tally.count += 1
            tally.good += any(sentence.startswith(place) for sentence in said)
            tally.alone += len(said) == 1
    return tallies


def other_convention(given: list[Sheet], rng: np.random.Generator, times: list[float]) -> Tally:
    """A right table of the other convention, of arms that have one between the given frames."""
    tally = Tally()
    for sheet in given:
        asked = sheet.answer.convention
        other = "modified" if asked == "standard" else "standard"
        rows = _between_given_frames(sheet, other, rng)
        if rows is None or not is_another_arm(sheet, rows):
            continue
        said = told(sheet, rows, times)
        tally.count += 1
        tally.good += any(f"This is the {other} table" in sentence for sentence in said)
        tally.alone += len(said) == 1
    return tally


def _between_given_frames(sheet: Sheet, other: Any, rng: Any) -> np.ndarray | None:
    """Rows of the other convention from the given base to the given tool; None without any."""
    rows = placed_otherwise(sheet.chain, sheet.given, rng, other)
    same = replace(sheet, answer=replace(sheet.answer, convention=other))
    q = np.random.default_rng(3).uniform(-1, 1, len(rows))
    wanted = hand(sheet.rows, sheet.answer.kinds, sheet.answer.convention, q)
    off = np.abs(hand(rows, same.answer.kinds, other, q) - wanted).max()
    return rows if off < 1e-9 else None


def main() -> None:
    """Prints a row for every kind of table, then the times."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seed", type=int, default=0)
    rng = np.random.default_rng(parser.parse_args().seed)
    all_sheets = [*sheets(rng)]

    times: list[float] = []
    tallies = legitimate(all_sheets, rng, times) | wrong(all_sheets, rng, times)
    print(f"{'':36}{'tables':>8}{'as it should be':>18}")
    for name, tally in tallies.items():
        print(f"{name:36}{tally.count:8}{tally.good:18}")
    print(spread(times))

    for policy in POLICIES:
        times = []
        asked = [sheet for sheet in all_sheets if sheet.policy == policy]
        tallies = singles(asked, rng, times)
        if policy == "all given":
            tallies["the other convention"] = other_convention(asked, rng, times)
        print(f"\n{f'single mistakes, {policy}':36}{'tables':>8}{'named':>18}{'nothing else':>18}")
        for name, tally in tallies.items():
            print(f"{name:36}{tally.count:8}{tally.good:18}{tally.alone:18}")
        print(spread(times))


def spread(times: list[float]) -> str:
    """Times of the processor per table [ms] in words."""
    median, late, most = np.median(times), np.quantile(times, 0.95), np.max(times)
    return f"per table: median {median:.1f} ms, 95% under {late:.1f} ms, most {most:.1f} ms"


if __name__ == "__main__":
    main()
