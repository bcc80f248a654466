"""The kinds of answers, as an exercise file imports them; each is a file of kinds/."""

from .kinds.arguments import Calls
from .kinds.choice import LETTERS, Choice
from .kinds.conditions import Conditions
from .kinds.configurations import Configurations
from .kinds.formulas import Formulas
from .kinds.function import Function
from .kinds.kind import Kind, Variant
from .kinds.manual import Manual
from .kinds.numbers import Numbers
from .kinds.results import Results
from .kinds.table import TableOf

__all__ = [
    "LETTERS",
    "Answer",
    "Calls",
    "Choice",
    "Conditions",
    "Configurations",
    "Formulas",
    "Function",
    "Manual",
    "Numbers",
    "Results",
    "TableOf",
    "Variant",
]

Answer = Kind
"""What a part asks for: one of these kinds."""
