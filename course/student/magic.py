"""`%check` in a notebook: what `kinegrade check` says of it, as it was saved."""

import os
import shlex
from datetime import datetime
from pathlib import Path
from typing import Any

from ...solutions.errors import KinegradeError
from ..settings.config import CourseError
from ..sheet.handout import read_handout
from .check import check_file, remark_lines

NAMED_BY_JUPYTER = "JPY_SESSION_NAME"
NAMED_BY_VSCODE = "__vsc_ipynb_file__"


def check(line: str) -> None:
    """Looks at one's own answers as far as the sheet's mode allows: %check, or %check FILE.

    It looks at the notebook as it was saved, run from top to bottom as it will be marked.
    """
    try:
        path = _notebook(line)
        handout, found = check_file(path)
        saved = datetime.fromtimestamp(path.stat().st_mtime)  # noqa: DTZ006 - the clock on the wall
    except (KinegradeError, OSError) as error:
        print(error)  # noqa: T201 - the output of the cell
        return
    lines = [*remark_lines(found), handout.told()]
    lines.append(f"{path.name} as it was saved at {saved:%H:%M:%S}; save it to have changes seen.")
    print("\n".join(lines))  # noqa: T201


def _notebook(line: str) -> Path:
    """The file that is named, else the one in which the kernel runs, else the only sheet here.

    Raises:
        CourseError: none of these is there.
    """
    named = shlex.split(line)
    if len(named) == 1:
        return Path(named[0])
    if named:
        raise CourseError(f"%check takes one file, got {line}")
    own = _own()
    if own is not None:
        return own

    sheets = [path for path in sorted(Path().glob("*.ipynb")) if _is_sheet(path)]
    if len(sheets) == 1:
        return sheets[0]
    listed = ", ".join(path.name for path in sheets) or "no sheet"
    raise CourseError(f"this folder has {listed}; say which: %check FILE.ipynb")


def _own() -> Path | None:
    """The notebook in which the kernel runs, as Jupyter or Visual Studio Code tell it."""
    from IPython.core.getipython import get_ipython

    shell: Any = get_ipython()
    told: list[str] = [os.environ.get(NAMED_BY_JUPYTER, "")]
    if shell is not None:
        told.append(str(shell.user_ns.get(NAMED_BY_VSCODE, "")))
    for name in told:
        if name.endswith(".ipynb") and Path(name).exists():
            return Path(name)
    return None


def _is_sheet(path: Path) -> bool:
    try:
        read_handout(path)
    except CourseError:
        return False
    return True
