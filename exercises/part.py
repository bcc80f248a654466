r'''The contract of an exercise file. Read this first, then any file of catalogue/: it reads as its sheet does.

    def draw(rng):
        return {"l1": length(rng), "l2": length(rng), "q": angles(rng, 2, [(0, 1)])}

    @part(2, Numbers((2, 2), "m/rad", 3), mistakes=[("A sign of the first row is wrong.", lambda J: J * [[-1], [1]])])
    def J(arm):
        r"""The 2 x 2 block $\mathbf J$ for $v_x, v_y$

        - The position is known; differentiate it.

        Differentiate the position by $q_1$ and $q_2$. With your numbers:
        $$\mathbf J = <J>$$
        """
        return arm.J[:2]

    EXERCISE = exercise("speed", title="...", source="...", robot=ROBOTS["planar_2r"], draw=draw, parts=[J])

A part is a function. Its name is the variable on the sheet (`speed_J`), its docstring is question, hints and worked
solution (worked.py). Its parameters are names on the sheet: drawn numbers, `arm` (arm.py), and earlier parts, which it
then needs - when a student is marked, they come from the student's own answers. Mistakes, checks, `shows` and the
statement take parameters of the same kind; they may take the part itself too - by its name as a parameter, since a
decorator stands above the function - and `v` stands for all drawn numbers.
'''

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..solutions.errors import nearest
from ..solutions.robot import Robot
from ..solutions.robots import ROBOTS
from .answers import Answer, TableOf, Variant
from .arm import Arm, arm_of, units_of
from .contract.introduction import drawn_arm, home_and_now, introduction, off_the_drawing
from .contract.names import Function, Names
from .contract.question import Question, Wrong, put_on_sheet
from .drawing import Drawing
from .exercise import Exercise, ExerciseError, Part, Rows

RobotOf = Robot | Callable[..., Robot]


@dataclass(frozen=True, eq=False)
class Setting:
    """What a ready-made question (questions/) fits itself to.

    Attributes:
        arm: The arm of a first draw: its robot, or one like it.
        rows: The order of the rows of a twist.
        earlier: What the parts before the question ask for, by their names.
    """

    arm: Arm
    rows: Rows
    earlier: Mapping[str, Answer]

    @property
    def robot(self) -> Robot:
        """The robot, or one like it."""
        return self.arm.robot


Ready = Callable[[Setting], Question]
"""A question that is ready for any robot."""


def part(
    points: float,
    answer: Answer,
    *,
    mistakes: Sequence[Wrong] = (),
    check: Function | None = None,
    shows: Mapping[str, Function] | None = None,
    **options: Any,
) -> Callable[[Function], Question]:
    """The function below it as a part that asks for this kind of answer (answers.py).

    `mistakes` are known wrong ways, each with the sentence that names it. `check(value)` judges what is not unique, or
    names another reading of the question, and returns an `Outcome` or nothing. `shows` are values for the worked
    solution. `options` are `follow`, `credit`, `tolerance` and `asked` of `Part` in exercise.py.
    """

    def decorated(solve: Function) -> Question:
        return Question(
            solve, solve.__name__, points, answer, mistakes, check, shows or {}, options
        )

    return decorated


def exercise(
    slug: str,
    *,
    title: str,
    source: str,
    draw: Callable[[np.random.Generator], dict[str, Any]],
    parts: Sequence[Question | Ready],
    robot: RobotOf | None = None,
    sizes: tuple[str, ...] | None = None,
    statement: str | Function | None = None,
    drawings: Function | None = None,
    units: Mapping[str, Any] | None = None,
    hidden: tuple[str, ...] = (),
    structure: tuple[str, ...] = (),
    scale: float | Function | None = None,
    rows: Rows = "linear, angular",
    robot_map: str | None = None,
    **about: Any,
) -> Exercise:
    """An exercise of these parts, in the order of the sheet.

    With a `robot`, or a function of drawn numbers that returns one, `arm` is known to all functions, and so are the
    units of q and of the robot's lengths; `sizes` names the drawn numbers that are its lengths where not all are.
    All else that is drawn stands in `units` (printed), `hidden` (for the instructor alone) or `structure` (choices of
    form, neither printed nor secret). `statement` is text or returns it, `drawings` returns a `Drawing` or several; a
    robot alone brings both. `scale` is a typical length [m], by default the size of the arm. `robot_map` is a robot of
    the catalogue whose map stands in the report. `about` are `objectives`, `minutes` and `symbols` of `Exercise`.

    Raises:
        ExerciseError: a name stands for nothing, or the file breaks the contract otherwise.
    """
    known_units = {**_units_of_robot(robot, sizes, (*hidden, *structure)), **(units or {})}
    drawn = frozenset((*known_units, *hidden, *structure))
    names = Names(slug, drawn, _arm(robot, Names(slug, drawn, None), sizes))
    questions = _questions(parts, names, draw, rows)
    _check_names(slug, questions, known_units)
    if statement is None and any(isinstance(question.answer, TableOf) for question in questions):
        statement, drawings = (
            off_the_drawing,
            drawings or home_and_now,
        )  # a printed table would be the answer
    if robot_map is None and isinstance(robot, Robot) and ROBOTS.get(robot.name) is robot:
        robot_map = robot.name
    return Exercise(
        slug=slug,
        title=title,
        source=source,
        draw=_checked(draw, names),
        parts=tuple(_placed(questions, names)),
        statement=_statement(names, statement),
        units=known_units,
        scale=_scale(names, scale),
        hidden=hidden,
        structure=structure,
        drawings=_drawings(names, drawings, standard=statement is None),
        rows=rows,
        named=(*(units or {}), *hidden, *structure),
        robot=robot_map,
        **about,
    )


def _units_of_robot(
    robot: RobotOf | None, sizes: tuple[str, ...] | None, unprinted: Sequence[str]
) -> dict[str, str | list[str]]:
    """Units of q and of the lengths, for a robot that is known when the file loads, but for what is not printed."""
    if not isinstance(robot, Robot):
        return {}
    return {name: unit for name, unit in units_of(robot, sizes).items() if name not in unprinted}


def _arm(
    robot: RobotOf | None, names: Names, sizes: tuple[str, ...] | None
) -> Callable[[Variant], Arm] | None:
    if robot is None:
        return None
    if isinstance(robot, Robot):
        return lambda v: arm_of(robot, v, sizes)
    bound = names.bound(robot, "the robot")
    return lambda v: arm_of(bound(names, v, {}), v, sizes)


def _questions(
    parts: Sequence[Question | Ready],
    names: Names,
    draw: Callable[[np.random.Generator], dict[str, Any]],
    rows: Rows,
) -> list[Question]:
    """The parts, ready-made ones fitted to the robot of a first draw."""
    if all(isinstance(one, Question) for one in parts):
        return [one for one in parts if isinstance(one, Question)]
    if names.arm is None:
        raise ExerciseError(
            f"exercise {names.slug}: a ready-made question takes an exercise with a robot"
        )
    arm = names.arm(draw(np.random.default_rng(0)))
    questions: list[Question] = []
    for one in parts:
        earlier = {question.name: question.answer for question in questions}
        questions.append(one if isinstance(one, Question) else one(Setting(arm, rows, earlier)))
    return questions


def _check_names(slug: str, questions: Sequence[Question], printed: Mapping[str, Any]) -> None:
    """A part and a printed number of one name would be one variable in the student's notebook."""
    for question in questions:
        if question.name in printed or question.name in ("v", "arm", "value"):
            raise ExerciseError(
                f"exercise {slug}: a part cannot be called {question.name}, which is something else's name here"
            )


def _placed(questions: Sequence[Question], names: Names) -> list[Part]:
    placed: list[Part] = []
    earlier: list[str] = []
    for question in questions:
        placed.append(put_on_sheet(question, names, earlier))
        earlier.append(question.name)
    return placed


def _checked(
    draw: Callable[[np.random.Generator], dict[str, Any]], names: Names
) -> Callable[[np.random.Generator], dict[str, Any]]:
    """A draw that is refused where a number would stand on no sheet and in no list."""

    def checked(rng: np.random.Generator) -> dict[str, Any]:
        v = draw(rng)
        for name in v:
            if name not in names.drawn:
                near = nearest(name, names.drawn)
                hint = f"; is {near!r} there meant for it?" if near else ""
                raise ExerciseError(
                    f"exercise {names.slug}: draw returns {name!r}, which stands neither in units (printed) nor in "
                    f"hidden nor in structure{hint}"
                )
        return v

    return checked


def _statement(names: Names, statement: str | Function | None) -> Callable[[Variant], str]:
    if isinstance(statement, str):
        return lambda _: statement
    if statement is None:
        if names.arm is None:
            raise ExerciseError(
                f"exercise {names.slug}: a statement is missing; only a robot brings one"
            )
        statement = introduction
    bound = names.bound(statement, "the statement")
    return lambda v: bound(names, v, {})


def _scale(names: Names, scale: float | Function | None) -> Callable[[Variant], float]:
    if isinstance(scale, int | float):
        return lambda _: float(scale)
    if scale is None:
        if names.arm is None:
            raise ExerciseError(
                f"exercise {names.slug}: scale, a typical length [m], is missing; only a robot brings one"
            )
        return _size_of(names.arm)
    bound = names.bound(scale, "scale")
    return lambda v: float(bound(names, v, {}))


def _size_of(arm: Callable[[Variant], Arm]) -> Callable[[Variant], float]:
    return lambda v: arm(v).size


def _drawings(
    names: Names, drawings: Function | None, *, standard: bool
) -> Callable[[Variant], tuple[Drawing, ...]]:
    if drawings is None:
        if not (standard and names.arm):
            return lambda _: ()
        drawings = drawn_arm
    bound = names.bound(drawings, "drawings")

    def drawn(v: Variant) -> tuple[Drawing, ...]:
        found = bound(names, v, {})
        return (found,) if isinstance(found, Drawing) else tuple(found)

    return drawn
