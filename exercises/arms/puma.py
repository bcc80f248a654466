"""The Puma 560 as the sheets of S3 5 show it."""

from ...solutions.robots import ROBOTS
from ..arm import Arm
from ..drawing import Drawing
from ..printed_table import printed_table, table_rows

PUMA = ROBOTS["puma560"]
REACH = PUMA.parameters["a2"] + PUMA.parameters["d4"]  # [m]
TABLE = f"""The Puma 560 has six revolute joints. Its table in the **standard** Denavit–Hartenberg convention (metres):

{printed_table(table_rows(PUMA, PUMA.parameters))}"""


def drawn(arm: Arm) -> Drawing:
    """The arm at the student's q."""
    return arm.drawing(
        "Puma 560 at your q, with frame 0 and the tool frame.",
        "Puma 560 arm with six revolute joints, drawn at your q.",
        arrows=False,
    )
