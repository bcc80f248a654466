"""The tables of course.toml: their keys, what each may hold, and what holds when it is left out."""

from collections.abc import Mapping
from datetime import datetime
from typing import Annotated, Any, Literal
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from pydantic import BaseModel, ConfigDict, Field, field_validator

from ..language.speech import ENGLISH, Language
from .roster import SAFE_NAME

Mode = Literal["practice", "graded", "exam"]
Format = Literal["ipynb", "pdf"]
"""What a sheet and its worked solution are written as."""
Attempts = Literal["last", "best"]
"""Which submission of a student counts, where there were several."""

Name = Annotated[str, Field(pattern=rf"^{SAFE_NAME.pattern}$")]
Title = Annotated[str, Field(max_length=300)]
Share = Annotated[float, Field(strict=True, ge=0, le=1)]
Points = Annotated[float, Field(gt=0, le=10_000)]
Decimals = Annotated[int, Field(strict=True, ge=0, le=9)]
Factor = Annotated[float, Field(ge=0.01, le=1000)]
ADJUSTMENTS = {"points", "decimals", "tolerance", "hints", "exercise", "part"}
Percent = Annotated[float, Field(ge=0, le=100)]


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Adjusted(_Strict):
    """What an instructor sets otherwise than the exercise has it.

    Attributes:
        points: Of everything below, which keeps its proportions.
        decimals: Asked of numbers.
        tolerance: A factor on the tolerance of numbers, which follows from the decimals.
    """

    points: Points | None = None
    decimals: Decimals | None = None
    tolerance: Factor | None = None


class ExerciseTable(Adjusted):
    """One exercise of a sheet, as `[sheet.exercise.NAME]`.

    Attributes:
        hints: Whether its hints are printed; else as the sheet says.
    """

    hints: bool | None = None


class PartTable(Adjusted):
    """One part, as `[[sheet.part]]`.

    Attributes:
        name: Its variable.
        drop: It is not asked.
    """

    name: Annotated[str, Field(max_length=200)]
    drop: bool = False


class Sheet(Adjusted):
    """One hand-out: its exercises in order, what is asked of them, and when.

    Attributes:
        name: That of its files.
        title: On the sheet; else its name.
        mode: What a check may tell a student.
        matlab: Students get a MATLAB script to start from beside the notebook.
        python: Students get a Python script to start from beside the notebook.
        show_solutions: The feedback holds the worked solution, which is for after the deadline.
        exercises: Their names, in the order of the sheet.
        pinned: By exercise, the choices of form that all students shall have alike, so that points
            mean the same for everybody.
        instructions: Markdown that stands on the sheet below its title.
        minutes: What the sheet is said to take; left out, what its exercises say, together.
        hints: Whether hints are printed.
        release: When students get the sheet.
        deadline: Until when it is to be handed in.
        grace_minutes: How much later is still in time.
        late_percent: Of the points, for each day begun after that.
        late_most: Percent that being late costs at most.
        closes: What comes in later does not count.
        attempts: Which of several submissions counts.
        most_attempts: How many submissions count; left out, any number.
        resit_of: The sheet of which this is a second try; the better of both counts.
        language: Of the sheet and its feedback; that of the course where it is left out.
    """

    name: Name
    title: Title = ""
    mode: Mode = "graded"
    matlab: bool = False
    python: bool = False
    show_solutions: bool = False
    exercises: Annotated[tuple[str, ...], Field(min_length=1, max_length=100)]
    pinned: Mapping[str, Mapping[str, Any]] = {}
    instructions: Annotated[str, Field(max_length=5000)] = ""
    minutes: Annotated[int, Field(strict=True, ge=1, le=10_000)] | None = None
    hints: bool = True
    exercise: Mapping[str, ExerciseTable] = {}
    part: tuple[PartTable, ...] = ()
    release: datetime | None = None
    deadline: datetime | None = None
    grace_minutes: Annotated[int, Field(strict=True, ge=0, le=100_000)] = 0
    late_percent: Percent = 0.0
    late_most: Percent = 100.0
    closes: datetime | None = None
    attempts: Attempts = "last"
    most_attempts: Annotated[int, Field(strict=True, ge=1, le=1000)] | None = None
    resit_of: str = ""
    language: Language = ENGLISH

    @property
    def is_timed(self) -> bool:
        """Whether it matters when and how often something was handed in."""
        limited = self.most_attempts is not None or self.attempts == "best"
        return limited or self.deadline is not None or self.closes is not None

    def adjustments(self) -> dict[str, Any]:
        """As plain data, what answers are judged by here otherwise than their exercises say."""
        return self.model_dump(mode="json", include=ADJUSTMENTS, exclude_defaults=True)


class LimitsTable(_Strict):
    """What one notebook may use while it is marked.

    Attributes:
        cell_seconds: Of the processor, for one cell; a loop costs the answers of its cell only.
        notebook_seconds: By the clock, for all cells together.
        memory_mb: Megabytes.
    """

    cell_seconds: Annotated[float, Field(strict=True, ge=1, le=600)] = 30.0
    notebook_seconds: Annotated[float, Field(strict=True, ge=1, le=3600)] = 180.0
    memory_mb: Annotated[int, Field(strict=True, ge=256, le=65_536)] = 2048


class PackagesTable(_Strict):
    """What notebooks may import.

    Attributes:
        allow: Packages, besides numpy, sympy, matplotlib, scipy and IPython.
    """

    allow: tuple[Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]*$")], ...] = ()


class MarkingTable(_Strict):
    """What a mistake that has a name costs of its part: once, whatever the number of entries.

    Attributes:
        slip: A sign, one entry, two rows exchanged, too few decimals.
        presentation: Transposed, blocks swapped, millimetres, degrees.
        concept: What the exercise knows of the question.
    """

    slip: Share = 0.25
    presentation: Share = 0.25
    concept: Share = 0.5


class GradebookTable(_Strict):
    """Where the gradebook lies, unless it is the file in the course folder.

    Attributes:
        url: Of a PostgreSQL database, such as postgresql://marker@db.example.org/robotics.
    """

    url: Annotated[str, Field(pattern="^postgresql://")] | None = None


class Settings(_Strict):
    """All of course.toml.

    Attributes:
        title: Of the course; it stands on every sheet and page.
        formats: What sheets and worked solutions are written as.
        timezone: That of times that name none, such as Europe/Berlin.
        language: Of sheets, feedback and checks; it says how grades.csv writes numbers, too.
    """

    title: Title
    # Of older courses; the secret has a file of its own.
    secret: Annotated[str, Field(min_length=16, max_length=1000)] | None = None
    sheet: Annotated[tuple[Sheet, ...], Field(min_length=1, max_length=200)]
    formats: Annotated[tuple[Format, ...], Field(min_length=1, max_length=2)] = ("ipynb",)
    limits: LimitsTable = LimitsTable()
    marking: MarkingTable = MarkingTable()
    gradebook: GradebookTable = GradebookTable()
    packages: PackagesTable = PackagesTable()
    timezone: str = "UTC"
    language: Language = ENGLISH

    @property
    def zone(self) -> ZoneInfo:
        """The time zone of times that name none."""
        return ZoneInfo(self.timezone)

    @field_validator("timezone")
    @classmethod
    def _known_zone(cls, name: str) -> str:
        try:
            ZoneInfo(name)
        except (ZoneInfoNotFoundError, ValueError) as error:
            raise ValueError("takes a name such as Europe/Berlin") from error
        return name
