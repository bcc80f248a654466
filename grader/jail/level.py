"""How much stands between a notebook and the machine that marks it."""

from dataclasses import dataclass
from enum import StrEnum

from ...solutions.errors import KinegradeError

ON_LINUX = "notebooks are marked on Linux (on Windows: WSL2, on macOS: a Linux machine)"


class Level(StrEnum):
    """The walls around a notebook, the most first."""

    STRONG = "strong"
    MEDIUM = "medium"
    UNSAFE = "unsafe"


WALLS = {
    Level.STRONG: "bubblewrap, Landlock and seccomp: each sees no file but its own, and no network",
    Level.MEDIUM: "Landlock and seccomp: each reads no file but its own, and reaches no network",
    Level.UNSAFE: "limits alone: each can do whatever the person who marks can do",
}
"""What each level is made of, as a report says it."""


class JailError(KinegradeError):
    """Notebooks cannot run here as they should."""


@dataclass(frozen=True)
class Permission:
    """How far a command may go down; nothing below strong unless somebody said so."""

    accept_medium: bool = False
    unsafe: bool = False

    def levels(self) -> list[Level]:
        """The levels that may be used, the best first."""
        permitted = [Level.STRONG]
        if self.accept_medium or self.unsafe:
            permitted.append(Level.MEDIUM)
        if self.unsafe:
            permitted.append(Level.UNSAFE)
        return permitted


ANY = Permission(accept_medium=True, unsafe=True)
"""For notebooks that the person who runs them wrote: whatever there is, without asking."""
