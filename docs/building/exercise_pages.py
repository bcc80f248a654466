"""A page for every exercise, from its file: what it asks, its pictures, its known mistakes."""

from collections.abc import Iterable, Iterator
from html import escape

import numpy as np
from kinegrade.course.pages.robot_maps import map_of
from kinegrade.course.sheet.assignment import Assignment
from kinegrade.course.sheet.given import given_form, given_numbers
from kinegrade.course.sheet.heading import STACKED
from kinegrade.course.sheet.question import prompt_text
from kinegrade.course.text.formulas import page_text
from kinegrade.course.text.words import points_text
from kinegrade.course.variants.drawn import drawn
from kinegrade.exercises.exercise import Exercise, Part
from kinegrade.exercises.files.finding import exercise_files, find
from kinegrade.solutions.robots import robot
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

FOLDER = "exercises"
INDEX = f"{FOLDER}/index.md"
SEED = 0  # the draw that is shown
INTRODUCTION = """
Each is one Python file, from which its page is written. A student's sheet has other numbers than
those shown here, and often another form of the arm. A course may set points, decimals and parts
otherwise: see [Settings](../settings.md). `kinegrade preview NAME` shows the worked solution and
the feedback of every known mistake.
"""


def names() -> list[str]:
    """The pages that are written."""
    return [INDEX, *(f"{FOLDER}/{slug}.md" for slug in sorted(exercise_files()))]


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Adds the pages and their pictures."""
    known = exercise_files()
    exercises = [find(slug, known) for slug in sorted(known)]
    files.append(File.generated(config, INDEX, content=index(exercises)))
    for exercise in exercises:
        page = f"{FOLDER}/{exercise.slug}"
        assignment = Assignment(exercise, drawn(exercise, np.random.default_rng(SEED)))
        for number, figure in enumerate(assignment.figures, 1):
            files.append(File.generated(config, f"{page}-{number}.svg", content=figure.svg))
        robot_map = ""
        if exercise.robot is not None:
            image, robot_map = map_of(exercise.robot)
            files.append(File.generated(config, f"{page}-map.png", content=image))
        text = "\n\n".join(blocks(assignment, robot_map))
        files.append(File.generated(config, f"{page}.md", content=text))
    return files


def index(exercises: list[Exercise]) -> str:
    """The list of all exercises."""
    rows = ["| exercise | title | parts | points | minutes | source |", "|---|---|--:|--:|--:|---|"]
    for one in exercises:
        link = f"[`{one.slug}`]({one.slug}.md)"
        numbers = f"{len(one.asked)} | {one.points:g} | {one.minutes}"
        rows.append(f"| {link} | {one.title} | {numbers} | {one.source} |")
    return "\n\n".join(["# Exercises", INTRODUCTION.strip(), "\n".join(rows)])


def blocks(assignment: Assignment, robot_map: str) -> Iterator[str]:
    """Markdown of a page, block by block.

    `robot_map` describes the map of its robot; it is empty where there is none.
    """
    exercise = assignment.exercise
    yield f"# {exercise.title}"
    yield _about(exercise)
    yield from _objectives(exercise)
    yield "## The sheet"
    yield "With the numbers of one draw:"
    yield exercise.statement(assignment.v)
    yield from given_numbers(exercise, assignment.v)
    yield given_form(exercise, assignment.v)
    pictures: list[str] = []
    for number, figure in enumerate(assignment.figures, 1):
        pictures.append(_picture(f"{exercise.slug}-{number}.svg", figure.alt, figure.caption))
    yield _row(pictures)
    yield "## What is asked"
    for part in exercise.asked:
        yield from _part(part)
    if robot_map:
        yield "## Where its robot is singular"
        title = robot(exercise.robot or "").title
        yield _row([_picture(f"{exercise.slug}-map.png", robot_map, title)])


def _part(part: Part) -> Iterator[str]:
    yield f"### `{part.variable}`"
    points = points_text(part.points)
    asked = prompt_text(part, hints=False)
    yield f"*{points}.* " + asked.removeprefix(f"**`{part.variable}`** ({points}): ")
    if part.needs:
        needed = ", ".join(f"`{need}`" for need in part.needs)
        yield f"*Marked from the student's own {needed}.*"
    if part.mistakes:
        yield "Mistakes that are known and named:"
        yield "\n".join(f"- {mistake.sentence}" for mistake in part.mistakes)


def _about(exercise: Exercise) -> str:
    file = f"[exercises/catalogue/{exercise.slug}.py](../../exercises/catalogue/{exercise.slug}.py)"
    return (
        f"`{exercise.slug}` · {points_text(exercise.points)} · about {exercise.minutes} minutes · "
        f"after {exercise.source} ([sources](../conventions.md#sources)) · {file}\n\n"
        f"In its Jacobians and twists {STACKED[exercise.rows]}."
    )


def _objectives(exercise: Exercise) -> Iterator[str]:
    if exercise.objectives:
        yield "## What is learnt"
        yield "\n".join(f"- {objective}" for objective in exercise.objectives)


def _row(pictures: Iterable[str]) -> str:
    """Pictures side by side, where there is room."""
    return f'<div class="pictures">{"".join(pictures)}</div>'


def _picture(file: str, alt: str, caption: str) -> str:
    image = f'<a href="{file}"><img src="{file}" alt="{escape(alt)}" loading="lazy"></a>'
    return f"<figure>{image}<figcaption>{page_text(caption)}</figcaption></figure>"
