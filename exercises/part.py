r'''The contract of an exercise file. Read this first, then any file of catalogue/.

    def draw(rng):
        return {"l1": length(rng), "l2": length(rng), "q": angles(rng, 2, [(0, 1)])}

    SIGN = ("A sign of the first row is wrong.", lambda J: J * [[-1], [1]])

    @part(2, Numbers((2, 2), "m/rad", 3), mistakes=[SIGN])
    def J(arm):
        r"""The 2 x 2 block $\mathbf J$ for $v_x, v_y$

        - The position is known; differentiate it.

        Differentiate the position by $q_1$ and $q_2$. With your numbers:
        $$\mathbf J = <J>$$
        """
        return arm.J[:2]

    EXERCISE = exercise(
        "speed",
        title="...",
        source="...",
        robot=ROBOTS["planar_2r"],
        draw=draw,
        parts=[J],
    )

A part is a function. Its name is the variable on the sheet (`speed_J`), its docstring is question,
hints and worked solution (worked.py): the file reads as its sheet does. Its parameters are names on
the sheet: drawn numbers, `arm` (arm.py), and earlier parts, which it then needs - when a student is
marked, they come from the student's own answers. Mistakes, checks, `shows` and the statement take
parameters of the same kind; they may take the part itself too - by its name as a parameter, since a
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
from .arm import Arm, Array, arm_of, units_of
from .contract.introduction import home_and_now, off_the_drawing
from .contract.names import Function, Names
from .contract.question import Question, Wrong, put_on_sheet
from .contract.statement import drawings_of, scale_of, statement_of, with_frames
from .exercise import Exercise, ExerciseError, Part, Rows

RobotOf = Robot | Callable[..., Robot]
Draw = Callable[[np.random.Generator], dict[str, Any]]
"""Drawn numbers of one student, by their names on the sheet."""


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

    `mistakes` are known wrong ways, each with the sentence that names it. `check(value)` judges
    what is not unique, or names another reading of the question, and returns an `Outcome` or
    nothing. `shows` are values for the worked solution. `options` are `follow`, `credit`,
    `tolerance` and `asked` of `Part` in exercise.py.
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
    draw: Draw,
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

    With a `robot`, `arm` is known to all functions, and so are the units of q and of the robot's
    lengths. All else that is drawn stands in `units`, `hidden` or `structure`.

    Args:
        slug: The name of the file and the beginning of every variable.
        title: Its heading on the sheet.
        source: Where it comes from, such as a book and its section.
        draw: Returns plain numbers.
        parts: Functions under `part`, and ready-made questions (questions/).
        robot: A robot, or a function of drawn numbers that returns one.
        sizes: The drawn numbers that are lengths of the robot, where not all are.
        statement: Text or a function that returns it; a robot alone brings one.
        drawings: Returns a `Drawing` or several; a robot alone brings one.
        units: The unit of every drawn number that is printed.
        hidden: Drawn numbers that no sheet prints as such: inputs of a function, or the index of a
            sentence that the statement prints, which would tell the answer of a choice.
        structure: Drawn choices of form, which the sheet prints below the numbers.
        scale: A typical length [m], by default the size of the arm.
        rows: The order of the rows of a twist.
        robot_map: A robot of the catalogue whose map stands in the report.
        about: `objectives`, `minutes`, `symbols` and `harder` of `Exercise`.

    Raises:
        ExerciseError: a name stands for nothing, or the file breaks the contract otherwise.
    """
    own_units = units or {}
    unprinted = (*hidden, *structure)
    known_units = {**_units_of_robot(robot, sizes, unprinted), **own_units}
    drawn = frozenset((*known_units, *unprinted))
    without_arm = Names(slug, drawn, None)  # for a function that returns the robot
    names = Names(slug, drawn, _arm(robot, without_arm, sizes))

    questions = _questions(parts, names, draw, rows)
    _check_names(slug, questions, known_units)

    asks_for_table = any(isinstance(question.answer, TableOf) for question in questions)
    if statement is None and asks_for_table:  # a printed table would be the answer
        statement = off_the_drawing
        drawings = drawings or home_and_now
    if robot_map is None:
        robot_map = _name_in_catalogue(robot)

    figures = drawings_of(names, drawings, standard=statement is None)
    return Exercise(
        slug=slug,
        title=title,
        source=source,
        draw=_checked(draw, names),
        parts=tuple(_placed(questions, names)),
        statement=statement_of(names, statement),
        units=known_units,
        scale=scale_of(names, scale),
        hidden=hidden,
        structure=structure,
        drawings=figures,
        solved_drawings=with_frames(names, figures),
        arm=names.arm,
        rows=rows,
        named=(*own_units, *unprinted),
        robot=robot_map,
        factors=_factors(names.arm),
        **about,
    )


def _units_of_robot(
    robot: RobotOf | None, sizes: tuple[str, ...] | None, unprinted: Sequence[str]
) -> dict[str, str | list[str]]:
    """Units of q and of the printed lengths, for a robot that is known when the file loads."""
    if not isinstance(robot, Robot):
        return {}
    return {name: unit for name, unit in units_of(robot, sizes).items() if name not in unprinted}


def _name_in_catalogue(robot: RobotOf | None) -> str | None:
    """The name of a robot of the catalogue; a variation of one has none."""
    if isinstance(robot, Robot) and ROBOTS.get(robot.name) is robot:
        return robot.name
    return None


def _arm(
    robot: RobotOf | None, names: Names, sizes: tuple[str, ...] | None
) -> Callable[[Variant], Arm] | None:
    if robot is None:
        return None
    if isinstance(robot, Robot):
        return lambda v: arm_of(robot, v, sizes)
    bound = names.bound(robot, "the robot")
    return lambda v: arm_of(bound(names, v, {}), v, sizes)


def _factors(arm: Callable[[Variant], Arm] | None) -> Callable[[Variant], Array] | None:
    if arm is None:
        return None
    return lambda v: arm(v).factors


def _questions(
    parts: Sequence[Question | Ready],
    names: Names,
    draw: Draw,
    rows: Rows,
) -> list[Question]:
    """The parts, ready-made ones fitted to the robot of a first draw."""
    arm: Arm | None = None  # drawn once, and only where a ready-made part takes it
    questions: list[Question] = []
    for one in parts:
        if isinstance(one, Question):
            questions.append(one)
            continue
        if names.arm is None:
            raise ExerciseError(
                f"exercise {names.slug}: a ready-made question takes an exercise with a robot"
            )
        arm = arm or names.arm(draw(np.random.default_rng(0)))
        earlier = {question.name: question.answer for question in questions}
        questions.append(one(Setting(arm, rows, earlier)))
    return questions


def _check_names(slug: str, questions: Sequence[Question], printed: Mapping[str, Any]) -> None:
    """A part and a printed number of one name would be one variable in the student's notebook."""
    for question in questions:
        if question.name in printed or question.name in ("v", "arm", "value"):
            raise ExerciseError(
                f"exercise {slug}: a part cannot be called {question.name}, "
                "which is something else's name here"
            )


def _placed(questions: Sequence[Question], names: Names) -> list[Part]:
    placed: list[Part] = []
    earlier: list[str] = []
    for question in questions:
        placed.append(put_on_sheet(question, names, earlier))
        earlier.append(question.name)
    return placed


def _checked(draw: Draw, names: Names) -> Draw:
    """A draw that is refused where a number would stand on no sheet and in no list."""

    def checked(rng: np.random.Generator) -> dict[str, Any]:
        v = draw(rng)
        for name in v:
            if name in names.drawn:
                continue
            near = nearest(name, names.drawn)
            hint = f"; is {near!r} there meant for it?" if near else ""
            raise ExerciseError(
                f"exercise {names.slug}: draw returns {name!r}, which stands neither in units "
                f"(printed) nor in hidden nor in structure{hint}"
            )
        return v

    return checked
