"""Known mistakes in the numbers that go in: angles, lengths, signs, cells of a table."""

from .mistake import Known

AS_DEGREES = Known(
    "radians taken as degrees",
    "It is what comes out when the angles of q, given in radians, are taken as degrees.",
    "the angles of q, given in radians, are taken as degrees",
    "presentation",
    "numbers",
    topic="Units",
)
IN_DEGREES = Known(
    "degrees in sine and cosine",
    "The joint angles seem to stand in sine and cosine in degrees; these take radians.",
    "the joint angles stand in sine and cosine in degrees",
    "presentation",
    "numbers",
    topic="Units",
)
CONSTANTS_IN_DEGREES = Known(
    "table in degrees in sine and cosine",
    "The fixed angles of the links seem to stand in sine and cosine in degrees; these take "
    "radians.",
    "the fixed angles of the links stand in sine and cosine in degrees",
    "presentation",
    "numbers",
    topic="Units",
)
ALL_IN_DEGREES = Known(
    "all angles in degrees in sine and cosine",
    "All angles seem to stand in sine and cosine in degrees; these take radians.",
    "all angles stand in sine and cosine in degrees",
    "presentation",
    "numbers",
    prior=0.1,
    topic="Units",
)
OFFSETS = Known(
    "joint offset forgotten",
    "The fixed angle beside the joint variable seems to be forgotten.",
    "the fixed angle beside the joint variable is forgotten",
    "concept",
    "numbers",
)
OFFSET = Known(
    "joint offset forgotten",
    "Row {i}: the fixed part of theta seems to be forgotten.",
    "the fixed part of theta in row {i} is forgotten",
    "concept",
    "numbers",
    prior=0.05,
)
ALPHA_SIGNS = Known(
    "sign of alpha",
    "All angles alpha seem to have the other sign: alpha turns z of one frame into z of the next, "
    "about x.",
    "all angles alpha have the other sign",
    "slip",
    "numbers",
    prior=0.05,
    topic="Joints",
)
ALPHA_SIGN = Known(
    "sign of alpha",
    "Row {i}: alpha seems to have the other sign; look which way x points.",
    "alpha of row {i} has the other sign",
    "slip",
    "numbers",
    topic="Joints",
)
ALPHA_FORGOTTEN = Known(
    "alpha forgotten",
    "Row {i}: the turn alpha seems to be forgotten.",
    "the turn alpha of row {i} is forgotten",
    "concept",
    "numbers",
    prior=0.1,
)
ANGLE_SIGN = Known(
    "sign of a joint variable",
    "It fits the other sign of q[{i}].",
    "q[{i}] has the other sign",
    "slip",
    "numbers",
    prior=0.1,
)
A_AND_D = Known(
    "a and d exchanged",
    "Row {i}: a and d seem to be exchanged; d lies along z, a along x.",
    "a and d of row {i} are exchanged",
    "slip",
    "numbers",
    topic="Joints",
)
ALL_A_AND_D = Known(
    "a and d exchanged",
    "The columns a and d seem to be exchanged; d lies along z, a along x.",
    "the columns a and d are exchanged",
    "concept",
    "numbers",
    prior=0.05,
    topic="Joints",
)
THETA_AND_D = Known(
    "theta and d exchanged",
    "Row {i}: theta and d seem to be exchanged; theta turns about z, d slides along it.",
    "theta and d of row {i} are exchanged",
    "slip",
    "numbers",
    prior=0.1,
)
ALL_THETA_AND_D = Known(
    "theta and d exchanged",
    "The columns theta and d seem to be exchanged; theta turns about z, d slides along it.",
    "the columns theta and d are exchanged",
    "concept",
    "numbers",
    prior=0.1,
)
FORGOTTEN = Known(
    "length forgotten",
    "It fits {name} = 0: that number seems to be forgotten.",
    "{name} is forgotten",
    "concept",
    "numbers",
    prior=0.02,
)
ALL_FORGOTTEN = Known(
    "lengths forgotten",
    "All lengths seem to be forgotten.",
    "all lengths are forgotten",
    "concept",
    "numbers",
    prior=0.2,
)
LENGTH_SIGN = Known(
    "sign of a length",
    "It fits the other sign of {name}.",
    "{name} has the other sign",
    "slip",
    "numbers",
    prior=0.1,
)
CELL_FORGOTTEN = Known(
    "length forgotten",
    "Row {i}: {cell} seems to be forgotten.",
    "{cell} of row {i} is forgotten",
    "concept",
    "numbers",
    prior=0.03,
)
SHORT_PI = Known(
    "pi = 3.14",
    "It fits 3.14 in place of pi; take pi with all its digits.",
    "3.14 stands for pi",
    "slip",
    "numbers",
    prior=0.05,
)
BASE = Known(
    "base forgotten",
    "What lies between the base and the first joint seems to be forgotten.",
    "what lies between the base and the first joint is forgotten",
    "concept",
    "numbers",
    topic="Frames",
)
TOOL = Known(
    "tool forgotten",
    "What lies between the last joint's frame and the tool seems to be forgotten.",
    "what lies between the last joint's frame and the tool is forgotten",
    "concept",
    "numbers",
    topic="Frames",
)
STROKE_TURNS = Known(
    "stroke taken as an angle",
    "The stroke of joint {i} seems to be taken as an angle: that joint slides.",
    "the stroke of joint {i} is taken as an angle",
    "concept",
    "numbers",
    prior=0.1,
    topic="Joints",
)
PRODUCT = Known(
    "sum of angles",
    "Sine and cosine of the angles of joints {i} and {j} together seem to be taken as products of "
    "the single ones; look at the sum formulas again.",
    "sine and cosine of the sum of joints {i} and {j} are taken as products of the single ones",
    "concept",
    "frames",
    prior=0.05,
)
SUM = Known(
    "sum of angles as a sum",
    "Sine and cosine of the angles of joints {i} and {j} together seem to be taken as sums of the "
    "single ones; look at the sum formulas again.",
    "sine and cosine of the sum of joints {i} and {j} are taken as sums of the single ones",
    "concept",
    "frames",
    prior=0.06,
)
ABSOLUTE = Known(
    "angle taken as absolute",
    "The angle of joint {j} seems to be taken alone; joint {i} turns that link, too.",
    "the angle of joint {j} is taken alone, without that of joint {i}",
    "concept",
    "numbers",
    prior=0.05,
)
