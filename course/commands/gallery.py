"""A gallery of the catalogue's robots: every kind of figure of each, and one page in Markdown.

`python -m kinegrade.course.commands.gallery FOLDER` writes it; `make gallery` writes docs/gallery.
"""

import sys
from collections.abc import Callable, Iterable
from html import escape
from pathlib import Path

from ...solutions.robot import Robot
from ...solutions.robots import ROBOTS
from ..machine.console import progress
from ..machine.files import write_atomically

PAGE = "README.md"  # which code hosts show under the listing of a folder
WIDTHS = {"posture": 380, "ellipsoids": 380, "": 900, "workspace": 400, "singularities": 600}
"""How wide each kind is shown [px], in the order of the page; all maps together have no name."""


def write_gallery(
    folder: Path, robots: Iterable[Robot], step: Callable[[], None] = lambda: None
) -> Path:
    """The figures of all kinds of these robots, and the page that shows them with their words.

    Raises:
        FigureError: a robot has a single joint, hence no map.
    """
    folder.mkdir(parents=True, exist_ok=True)
    chapters = [HEAD]
    for robot in robots:
        chapters.append(_chapter(folder, robot))
        step()
    page = folder / PAGE
    write_atomically(page, "\n".join(chapters))
    return page


HEAD = """# The robots of the catalogue

Drawn by `make gallery`, each with the lengths of its source. `kinegrade plot NAME --kind KIND`
draws one of the figures, as .png, .svg or .pdf; `--student ID` draws it with a student's own
lengths.
"""


def _chapter(folder: Path, robot: Robot) -> str:
    """The heading of a robot, its figures and what they show in words, each sentence once."""
    from ...grader.figures.robot_figure import robot_figure

    images: list[str] = []
    said: list[str] = []
    for kind, width in WIDTHS.items():
        file = f"{robot.name}-{kind or 'map'}.png"
        drawn = robot_figure(robot, kind, Path(file).suffix)
        write_atomically(folder / file, drawn.data)
        alt = f"{kind.capitalize()} of {robot.title}, which the text below describes"
        if drawn.words not in said:
            alt = drawn.words
            said.append(drawn.words)
        images.append(f'<img src="{file}" alt="{escape(alt)}" width="{width}">')

    told = [words for words in said if not _is_part_of_another(words, said)]
    text = escape("\n\n".join(told), quote=False)
    source = escape(robot.source, quote=False)
    shown = "\n".join(images)
    return f"## {robot.title} (`{robot.name}`)\n\nSource: {source}.\n\n{shown}\n\n{text}\n"


def _is_part_of_another(words: str, said: Iterable[str]) -> bool:
    return any(words in other for other in said if other != words)


def main() -> None:
    """Writes the gallery into the folder that is named."""
    if len(sys.argv) != 2:
        sys.stderr.write("python -m kinegrade.course.commands.gallery takes one folder\n")
        sys.exit(2)
    with progress("Drawing robots", len(ROBOTS)) as step:
        page = write_gallery(Path(sys.argv[1]), ROBOTS.values(), step)
    print(page)


if __name__ == "__main__":
    main()
