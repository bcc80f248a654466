"""The command `kinegrade plot`: figures of a robot, with its own lengths or a student's."""

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...solutions.errors import KinegradeError
from ..machine.console import say
from .options import CourseOption, GradebookOption, opened

if TYPE_CHECKING:
    from ...solutions.robot import Robot


class Kind(StrEnum):
    """What a figure shows."""

    WORKSPACE = "workspace"
    SINGULARITIES = "singularities"
    ELLIPSOIDS = "ellipsoids"
    POSTURE = "posture"


AT_A_POSTURE = (Kind.ELLIPSOIDS, Kind.POSTURE)


def plot(
    robot: Annotated[str, typer.Argument(help="A robot of the catalogue, such as puma560.")],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="A .png, .svg or .pdf file.")
    ] = None,
    kind: Annotated[
        Kind | None,
        typer.Option("--kind", "-k", help="One of them; else workspace and singularities."),
    ] = None,
    q: Annotated[
        str | None,
        typer.Option(
            "--q",
            help="Joint values of a posture in rad and m, such as 0.1,0.5,-0.3, "
            "or the name of one that the robot has, such as qr.",
        ),
    ] = None,
    student: Annotated[
        str | None,
        typer.Option("--student", help="An id of roster.csv: with this student's own lengths."),
    ] = None,
    sheet: Annotated[
        str | None, typer.Option("--sheet", help="The sheet, where the robot is on several.")
    ] = None,
    exercise: Annotated[
        str | None,
        typer.Option("--exercise", help="The exercise, where several ask about the robot."),
    ] = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Draw a robot: workspace, singularities, ellipsoids, or the arm at a posture."""
    from ...grader.figures.robot_figure import robot_figure
    from ...solutions.robots import robot as find_robot
    from ..machine.files import write_atomically
    from .own_robot import own_robot

    arm = find_robot(robot)
    _refuse_what_does_not_go_together(q, kind, student, sheet or exercise)

    name, own = robot, None
    if student is not None:
        at_q = kind in AT_A_POSTURE and q is None
        with opened(folder, place) as (course, gradebook):
            sheets = course.sheets((sheet,) if sheet else ())
            own = own_robot(course, gradebook, sheets, student, arm, exercise, at_q=at_q)
        arm, name = own.robot, f"{robot}-{student}"
    posture = _posture(arm, q)
    if posture is None and own is not None:
        posture = own.q
    if kind:
        name += f"-{kind}"

    path = output or Path(f"{name}.png")
    lengths = None if own is None else own.lengths
    drawn = robot_figure(arm, kind or "", path.suffix, lengths, posture)
    write_atomically(path, drawn.data)
    print(path)
    say(drawn.words)


def _refuse_what_does_not_go_together(
    q: str | None, kind: Kind | None, student: str | None, choice: str | None
) -> None:
    """Refuses options without those that they take; `choice` is a sheet or an exercise."""
    if q is not None and kind not in AT_A_POSTURE:
        raise KinegradeError("--q takes --kind posture or ellipsoids; the other figures have no q")
    if student is None and choice:
        raise KinegradeError("--sheet and --exercise choose among a student's; they take --student")


def _posture(arm: "Robot", text: str | None) -> tuple[float, ...] | None:
    """The joint values of --q: numbers, or a posture of the robot by its name."""
    if text is None:
        return None
    if text in arm.poses:
        return arm.poses[text]
    words = text.replace(",", " ").split()
    try:
        values = tuple(float(word) for word in words)
    except ValueError:
        values = ()
    if len(values) != arm.n:
        known = ""
        if arm.poses:
            known = f", or one of {', '.join(arm.poses)}"
        raise KinegradeError(
            f"--q takes {arm.n} numbers for {arm.name}, such as "
            f"--q={','.join(['0.3'] * arm.n)}{known}; got {text!r}"
        )
    return values
