"""What a student has for a sheet: the verdicts, and what deadlines and people make of them."""

from dataclasses import dataclass, field

from ...grader.marking.verdict import Finding, Verdict
from ..settings.roster import Student
from ..settings.times import IN_TIME, Lateness

UNSAFE_STAMP = Finding(
    "This notebook was run at level unsafe: it could have changed any marks.",
    private=True,
)


@dataclass(frozen=True)
class Attempts:
    """Which of how many submissions it is that counts; 0 of 0 where that was not looked at.

    `stands` says whether it is the file that lies there.
    """

    this: int = 0
    of: int = 0
    stands: bool = True


@dataclass(frozen=True)
class Result:
    """One student's sheet: verdicts in the order of the parts, or why there are none.

    Attributes:
        student: Whose it is.
        sheet: The name of the sheet.
        verdicts: With what was decided by people.
        reason: Why there are no verdicts.
        passed_over: Names of files that look like other versions of the one that was marked.
        late: How late it came, and what that costs.
        excused: Whether the sheet does not count for this student.
        attempts: Which of several submissions counts.
        published: When students were told this result (ISO 8601); empty where they were not.
        by_now: The result as it would be published today, where that is another.
    """

    student: Student
    sheet: str
    verdicts: tuple[Verdict, ...] = ()
    reason: str = ""
    passed_over: tuple[str, ...] = ()
    late: Lateness = IN_TIME
    excused: bool = False
    attempts: Attempts = field(default_factory=Attempts)
    published: str = ""
    by_now: "Result | None" = None

    @property
    def points(self) -> float | None:
        """Points, less what being late costs.

        None while a part waits for the instructor, or where nothing came in or counts.
        """
        known = [verdict.points for verdict in self.verdicts if verdict.points is not None]
        if self.excused or not known or len(known) < len(self.verdicts):
            return None
        return round(sum(known) * self.late.share, 2)

    @property
    def so_far(self) -> float:
        """Points of the parts that have some, less what being late costs."""
        known = [verdict.points for verdict in self.verdicts if verdict.points is not None]
        return round(sum(known) * self.late.share, 2)

    @property
    def unsafe(self) -> bool:
        """Whether it was run without walls."""
        return any(UNSAFE_STAMP in verdict.findings for verdict in self.verdicts)

    @property
    def status(self) -> str:
        """graded, not_graded, no_submission or excused."""
        if self.excused:
            return "excused"
        if self.points is not None:
            return "graded"
        if self.verdicts:
            return "not_graded"
        return "no_submission"

    @property
    def earned(self) -> dict[str, float | None]:
        """Points by part; None where a part waits for its mark."""
        return {verdict.part: verdict.points for verdict in self.verdicts}

    def tells_the_same_as(self, other: "Result") -> bool:
        """Whether points, what waits and every part are those of another result."""
        own = (self.points, self.status, self.earned)
        return own == (other.points, other.status, other.earned)

    @property
    def out_of(self) -> float:
        """Points that could be had."""
        return sum(verdict.out_of for verdict in self.verdicts)
