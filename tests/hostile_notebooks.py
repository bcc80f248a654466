"""The hostile notebooks of tests/hostile, and the table of them: this file, run, writes it."""

import ast
import json
import re
from dataclasses import dataclass, field
from pathlib import Path

from courses import notebook

FOLDER = Path(__file__).parent / "hostile"
PAGE = Path(__file__).parents[1] / "docs" / "hostile.md"
LEVELS = ("strong", "medium")
CELL = "# %%\n"
NAMES = r"[xyf]|process|reached"
CLAIM = re.compile(
    rf"(?P<name>{NAMES}) (?P<verb>refused|lost|again|ended|is)(?:: | |$)(?P<value>.*)"
)
NEXT_CLAIM = re.compile(rf"; (?=(?:{NAMES}) (?:refused|lost|again|ended|is)\b)")
KINDS = {
    "answer": "Answers that are none, and tools turned round",
    "course": "The course, its secret, its gradebook, and classmates",
    "escape": "The grader and its memory",
    "folder": "Folders and files",
    "frame": "The pipe that answers take",
    "kernel": "The kernel",
    "limit": "Time, memory and room",
    "network": "The network",
    "process": "Processes and signals",
    "python": "Python and Jupyter",
}
INTRODUCTION = """\
# Hostile notebooks, and what becomes of them

Written by `python tests/hostile_notebooks.py` from [tests/hostile/](../tests/hostile), one file a row; tests/test_hostile.py
runs each at both [levels](security.md) beside a course with a secret, a gradebook, classmates' files and open sockets. Every
notebook is asked for two variables, `x` and `y`, and a function `f`, called with 1 and 2, and for `reached`, which it sets
where its attack begins: a notebook that stops before that proves nothing, and fails.

| words | what is found |
|---|---|
| refused | each attempt stopped with an error of the kernel, or one of those that are named, and the notebook went on |
| lost | there is no such answer, for good, and the student reads this sentence after "In your file"; `*` is any text |
| again | there is no such answer yet: it is not graded, with this sentence, and run again |
| process ended | the kernel ended the notebook at once, at a call that only an attack makes |
| is | this is the answer: its own, whatever it did to the tools around it |

And always: the course and the folders around it are unchanged byte for byte, nothing of the secret is in what came back,
nobody knocked at a socket, no process and no file is left, the grader is not disturbed, and the notebook that runs next in the
same jail finds an empty folder and gets its right answers.
"""


@dataclass(frozen=True)
class Claim:
    """What must have become of one answer, or of the process."""

    name: str
    verb: str
    value: object = None


@dataclass(frozen=True)
class Hostile:
    """One notebook: what it tries, what must happen, and at which levels it does not and why."""

    name: str
    tries: str
    must: str
    cells: tuple[str, ...]
    seconds: float = 20.0  # on the clock
    cell_seconds: float = 1.0  # of the processor
    through: dict[str, str] = field(default_factory=dict)

    @property
    def claims(self):
        """What must hold, one by one; that the attack was reached, where nothing else shows it."""
        claims = [_claim(text.strip(), self.name) for text in NEXT_CLAIM.split(self.must)]
        if any(claim.name in ("process", "reached") for claim in claims):
            return claims
        return [*claims, Claim("reached", "is", 1)]


def hostile_notebooks():
    """All of them, by name."""
    return [_read(path) for path in sorted(FOLDER.glob("*.py"))]


def first_cell(**known):
    """What an attacker who knows this machine well would begin with."""
    lines = [f"{name} = {json.dumps(value)}" for name, value in known.items()]
    return "\n".join([*lines, (FOLDER / "first_cell.txt").read_text(encoding="utf-8")])


def as_notebook(hostile, first):
    """Its bytes, as a student hands them in."""
    return notebook(first, *hostile.cells)


def table():
    """The page."""
    found = hostile_notebooks()
    parts = [INTRODUCTION]
    for kind, title in KINDS.items():
        rows = [_row(each) for each in found if each.name.startswith(f"{kind}_")]
        head = "| notebook | tries | must | strong | medium |\n|---|---|---|---|---|"
        parts.append("\n".join([f"## {title}\n", head, *rows]) + "\n")
    return "\n".join(parts)


def _read(path):
    head, *cells = path.read_text(encoding="utf-8").split(CELL)
    said = {"tries": ""}
    key = "tries"
    for line in head.splitlines():
        text = line.removeprefix("#").strip()
        found = re.match(
            r"(Must|Seconds|Cell seconds|Gets through at strong|Gets through at medium): ", text
        )
        if found:
            key = found[1]
            text = text[found.end() :]
        said[key] = f"{said.get(key, '')} {text}".strip()
    through = {}
    for level in LEVELS:
        why = said.get(f"Gets through at {level}")
        if why:
            through[level] = why
    return Hostile(
        path.stem,
        said["tries"],
        said["Must"],
        tuple(cells),
        float(said.get("Seconds", 20)),
        float(said.get("Cell seconds", 1)),
        through,
    )


def _claim(text, where):
    found = CLAIM.fullmatch(text)
    if not found:
        message = f"{where}: a claim is such as 'x refused' or 'x is 1', got {text!r}"
        raise ValueError(message)
    if found["verb"] in ("lost", "again") and not found["value"]:
        message = f"{where}: {text!r} takes the sentence that the student reads"
        raise ValueError(message)
    if found["verb"] == "is":
        return Claim(found["name"], "is", ast.literal_eval(found["value"]))
    return Claim(found["name"], found["verb"], found["value"])


def _row(each):
    link = f"[{each.name}](../tests/hostile/{each.name}.py)"
    ends = [each.through.get(level, "holds") for level in LEVELS]
    must = each.must.replace("<", "&lt;").replace("*", "\\*")  # as text, not as a tag or as stress
    texts = [text.replace("|", "\\|") for text in (each.tries, must)]
    return f"| {' | '.join([link, *texts, *ends])} |"


if __name__ == "__main__":
    PAGE.write_text(table(), encoding="utf-8")
