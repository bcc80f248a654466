# pyright: basic
"""Gradescope's "Export Submissions": a folder a submission, and who handed it in, as YAML."""

from collections.abc import Iterator, Mapping
from datetime import UTC, date, datetime
from typing import Any

import yaml

from ..errors import CourseError
from .archive import Contents, File
from .people import Owner
from .upload import Upload

METADATA = "submission_metadata.yml"
MOST = 64 << 20  # bytes of metadata


def recognizes(contents: Contents) -> bool:
    """Whether a download is Gradescope's."""
    return any(map(is_own, contents.files))


def is_own(file: File) -> bool:
    """Whether a file is Gradescope's own."""
    return file.path.name == METADATA


def uploads(contents: Contents) -> Iterator[Upload]:
    """Every file of every submission; a group's is that of each of its members.

    Raises:
        CourseError: the export does not say who handed in what.
    """
    for metadata in filter(is_own, contents.files):
        folder = metadata.path.parent
        submissions = _submissions(metadata)
        for file in contents.files:
            if file.path == metadata.path or not file.path.is_relative_to(folder):
                continue
            inside = file.path.relative_to(folder)
            about = _mapping(submissions.get(inside.parts[0]))
            received = _moment(about.get(":created_at"))
            for owner in _owners(about):
                yield Upload(owner, file.path.name, file, received)


def _submissions(metadata: File) -> Mapping[str, Any]:
    data = metadata.read()
    if len(data) > MOST:
        raise CourseError(f"{metadata.path} has more than {MOST >> 20} MB")
    try:
        content = yaml.load(data, _Loader)  # noqa: S506 - a SafeLoader
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise CourseError(f"{metadata.path} is no YAML: {error}") from error
    return _mapping(content)


class _Loader(yaml.SafeLoader):
    """Data only: what is marked as an object of Ruby's is read as the mapping that it is."""


def _plain(loader: yaml.SafeLoader, _: str, node: yaml.Node) -> Any:
    if isinstance(node, yaml.MappingNode):
        return loader.construct_mapping(node, deep=True)
    return None


_Loader.add_multi_constructor("!ruby/", _plain)


def _owners(about: Mapping[str, Any]) -> Iterator[Owner]:
    submitters = about.get(":submitters")
    if not isinstance(submitters, list):
        return
    for one in map(_mapping, submitters):
        ids = [str(one[key]) for key in (":sid", ":email") if one.get(key)]
        yield Owner(number=ids[0] if ids else "", ids=tuple(ids), name=str(one.get(":name") or ""))


def _moment(value: Any) -> datetime | None:
    """The time of a submission, which YAML reads as one; without a zone it is UTC."""
    if isinstance(value, datetime):
        return value if value.tzinfo else value.replace(tzinfo=UTC)
    if isinstance(value, str) and not isinstance(value, date):
        try:
            return _moment(datetime.fromisoformat(value))
        except ValueError:
            return None
    return None


def _mapping(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, dict) else {}
