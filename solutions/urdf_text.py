"""The XML of a URDF file: read without namespaces, as the tools that write URDF do."""

from os import PathLike
from pathlib import Path
from xml.etree import ElementTree as ET
from xml.parsers import expat

from .errors import KinegradeError

BLANK = "\ufeff \t\r\n"  # what may stand before the first element
XACRO = "xacro:"


class UrdfError(KinegradeError):
    """A URDF text that describes no serial chain."""


def robot_element(text_or_path: str | PathLike[str]) -> ET.Element:
    """The <robot> element of a URDF, given as a path or as text that starts with "<".

    Raises UrdfError.
    """
    text = _text(text_or_path)
    # looked for in the text, before a parser sees it: entities of a DTD can grow without bound or
    # name other files
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise UrdfError("a URDF takes no document type and no entities, got <!DOCTYPE or <!ENTITY")

    root = _parsed(text.lstrip(BLANK))
    _refuse_xacro(root)
    if root.tag != "robot":
        raise UrdfError(f"a URDF takes <robot> as its outermost element, got <{root.tag}>")
    return root


def _text(text_or_path: str | PathLike[str]) -> str:
    if isinstance(text_or_path, str):
        if text_or_path.lstrip(BLANK).startswith("<"):
            return text_or_path
        if not text_or_path.strip(BLANK):
            raise UrdfError(
                "read_urdf takes the path of a readable file, or a text that starts with <, "
                "got an empty text"
            )

    path = Path(text_or_path)
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise UrdfError(f"{path.name} takes UTF-8 text, got other bytes") from None
    except (OSError, ValueError) as error:
        raise UrdfError(
            "read_urdf takes the path of a readable file, or a text that starts with <, "
            f"got {error}"
        ) from None


def _parsed(text: str) -> ET.Element:
    """The outermost element, with prefixes left in the names.

    Many files use a prefix that they do not declare, or give a default namespace; neither says
    anything about the arm.
    """
    builder = ET.TreeBuilder()
    parser = expat.ParserCreate()
    parser.StartElementHandler = builder.start
    parser.EndElementHandler = builder.end
    parser.CharacterDataHandler = builder.data
    try:
        parser.Parse(text, True)  # noqa: FBT003 - expat takes it by place
    except (expat.ExpatError, ValueError) as error:
        raise UrdfError(f"a URDF takes well-formed XML, got {error}") from None
    return builder.close()


def _refuse_xacro(root: ET.Element) -> None:
    """Refuses a file that is still to be expanded."""
    for element in root.iter():
        if str(element.tag).startswith(XACRO):
            raise UrdfError(
                f"read_urdf takes a URDF, got a xacro file with <{element.tag}>; "
                "expand it first: xacro FILE > robot.urdf"
            )
