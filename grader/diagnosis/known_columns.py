"""Known mistakes behind the numbers: chains, columns of a Jacobian, what is handed in."""

from ...exercises.calculations import columns
from .mistake import Known

ORDER = Known(
    "order of the other convention",
    "The motions of a row seem to be multiplied in the order of the {other} convention.",
    "the motions of a row are multiplied in the order of the {other} convention",
    "convention",
    "frames",
    topic="Joints",
)
OTHER_TABLE = Known(
    "table of the other convention",
    "The table seems to be read as one of the {other} convention, in its transforms and in the "
    "axes of the joints.",
    "the table is read as one of the {other} convention, in transforms and axes",
    "convention",
    "frames",
    topic="Joints",
)
REVERSE = Known(
    "order of the product",
    "The transforms of the links seem to be multiplied in reverse order.",
    "the transforms of the links are multiplied in reverse order",
    "concept",
    "frames",
    prior=0.1,
    topic="Chains",
)
ONE_FRAME = Known(
    "all frames the last one",
    "All frames seem to be the last one: is a frame overwritten while the next one is computed?",
    "all frames are the last one",
    "concept",
    "frames",
    prior=0.05,
)
EARLY = Known(
    "chain one link short",
    "The chain seems to stop one link before the end.",
    "the chain stops one link before the end",
    "concept",
    "frames",
    prior=0.05,
)
LATE = Known("frame one late", columns.LATE, "column i is taken from the frame behind it",
             "concept", "columns", topic="Joints")  # fmt: skip
EARLY_FRAME = Known(
    "frame one early",
    "Column i seems to be taken from the frame before; here the axis of joint i is z of frame "
    "{at}.",
    "column i is taken from the frame before",
    "concept",
    "columns",
    prior=0.1,
    topic="Joints",
)
LATE_AXES = Known("axis one late", columns.LATE_AXES, "the axes are those of the next frame",
                  "concept", "columns", topic="Joints")  # fmt: skip
NEXT_AXES = Known(
    "axis one late",
    "The axes seem to be those of the next frame; the axis of joint i is z of frame {at}.",
    "the axes are those of the next frame",
    "concept",
    "columns",
    topic="Joints",
)
EARLY_AXES = Known(
    "axis one early",
    "The axes seem to be those of the frame before; the axis of joint i is z of frame {at}.",
    "the axes are those of the frame before",
    "concept",
    "columns",
    prior=0.1,
    topic="Joints",
)
LATE_AXIS = Known(
    "axis one late",
    "Column {i}: the axis seems to be that of the next frame.",
    "the axis in column {i} is that of the next frame",
    "concept",
    "columns",
    prior=0.15,
)
EARLY_AXIS = Known(
    "axis one early",
    "Column {i}: the axis seems to be that of the frame before.",
    "the axis in column {i} is that of the frame before",
    "concept",
    "columns",
    prior=0.2,
)
LATE_ORIGINS = Known(
    "lever from the next frame",
    "The lever arms seem to begin at the next frame; each begins on its joint's own axis.",
    "the lever arms begin at the next frame",
    "concept",
    "columns",
)
EARLY_ORIGINS = Known(
    "lever from the frame before",
    "The lever arms seem to begin at the frame before; each begins on its joint's own axis.",
    "the lever arms begin at the frame before",
    "concept",
    "columns",
    prior=0.1,
)
LATE_ORIGIN = Known(
    "lever from the next frame",
    "Column {i}: the lever arm seems to begin at the next frame.",
    "the lever arm of column {i} begins at the next frame",
    "concept",
    "columns",
    prior=0.15,
)
EARLY_ORIGIN = Known(
    "lever from the frame before",
    "Column {i}: the lever arm seems to begin at the frame before.",
    "the lever arm of column {i} begins at the frame before",
    "concept",
    "columns",
    prior=0.2,
)
OWN_LINK = Known("lever to the next frame", columns.OWN_LINK, "the levers end at the next frame",
                 "concept", "columns")  # fmt: skip
FROM_BASE = Known("lever from the base", columns.FROM_BASE, "the levers begin at the base",
                  "concept", "columns")  # fmt: skip
REVERSED = Known("order of the cross product", columns.REVERSED, "the cross products are reversed",
                 "concept", "columns")  # fmt: skip
REVERSED_COLUMN = Known(
    "order of the cross product",
    "Column {i}: the order of the cross product seems to be reversed.",
    "the cross product of column {i} is reversed",
    "slip",
    "columns",
    prior=0.15,
)
MIDDLE = Known(
    "second component of a cross product",
    "The second component of the cross products seems to lack its minus.",
    "the second component of the cross products lacks its minus",
    "slip",
    "columns",
    prior=0.05,
)
SLIDES = Known(
    "revolute taken as prismatic",
    "Column {i} looks as if joint {i} were prismatic; look again at its type.",
    "column {i} is that of a prismatic joint",
    "concept",
    "columns",
    topic="Units",
)
AXIS_FOR_PRODUCT = Known(
    "axis for the cross product",
    "Column {i}: the linear rows seem to hold the axis; joint {i} is revolute.",
    "the linear rows of column {i} hold the axis",
    "concept",
    "columns",
    prior=0.1,
)
TURNS = Known(
    "prismatic taken as revolute",
    "Column {i} looks as if joint {i} were revolute; look again at its type.",
    "column {i} is that of a revolute joint",
    "concept",
    "columns",
    topic="Units",
)
ALL_TURN = Known("prismatic taken as revolute", columns.TURNING,
                 "prismatic columns are those of revolute joints",
                 "concept", "columns", topic="Units")  # fmt: skip
TURNING_SLIDE = Known("axis of a slide in the angular rows", columns.TURNING_SLIDE,
                      "the axis of a slide stands in the angular rows, too",
                      "concept", "columns", topic="Units")  # fmt: skip
CROSSED_SLIDE = Known(
    "cross product of a slide",
    "Column {i}: the linear rows seem to hold a cross product; joint {i} slides.",
    "the linear rows of column {i} hold a cross product",
    "concept",
    "columns",
    prior=0.1,
    topic="Units",
)
NO_TURN = Known(
    "angular rows left out",
    "The angular rows seem to be left zero: a revolute joint turns the tool.",
    "the angular rows are left zero",
    "concept",
    "columns",
)
UPRIGHT = Known(
    "axes left in their own frames",
    "The axes seem to be (0, 0, 1) for all joints; each has to be turned into the asked axes.",
    "the axes are (0, 0, 1) for all joints",
    "concept",
    "columns",
)
SECOND_COLUMN = Known(
    "another column for z",
    "The axes seem to be another column of the rotations; z is the third one.",
    "the axes are another column of the rotations",
    "concept",
    "columns",
    prior=0.05,
)
IN_TOOL = Known("tool axes", columns.TOOL_AXES, "the rows are in the axes of the tool",
                "convention", "output", topic="Frames")  # fmt: skip
IN_BASE = Known(
    "base axes",
    "This is the Jacobian in base axes; the axes of the tool frame are asked.",
    "the rows are in base axes",
    "convention",
    "output",
    topic="Frames",
)
HALF_IN_TOOL = Known(
    "tool axes: linear rows alone",
    "Only the linear rows seem to be turned into the axes of the tool.",
    "the linear rows alone are in the axes of the tool",
    "convention",
    "output",
    prior=0.15,
    topic="Frames",
)
AT_ORIGIN = Known(
    "point at the base origin",
    "This is at the base origin; the tool point is asked.",
    "the point is that at the base origin",
    "convention",
    "output",
    prior=0.05,
    topic="Frames",
)
AT_TOOL = Known(
    "tool point",
    "This is the Jacobian of the tool point; another point is asked.",
    "the point is the tool point",
    "convention",
    "output",
    topic="Frames",
)
ANGLE_RATES = Known(
    "rates of angles",
    "The angular rows seem to be rates of {angles}; the angular velocity is asked.",
    "the angular rows are rates of {angles}",
    "convention",
    "output",
    prior=0.05,
    topic="Angle sets",
)
