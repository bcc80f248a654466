# pyright: basic
"""A notebook's file: cells and their identities, the same bytes every time."""

import hashlib
from typing import Any

import nbformat

KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}


def markdown_cell(text: str) -> Any:
    """A cell of Markdown."""
    return nbformat.v4.new_markdown_cell(text)


def code_cell(source: str, answer: str = "") -> Any:
    """A cell of Python; with `answer`, the one in which that variable is asked."""
    metadata: dict[str, Any] = {}
    if answer:
        # For people and tools that keep tags; answers are collected by the variable's name.
        metadata["tags"] = ["answer", answer]
    return nbformat.v4.new_code_cell(source, metadata=metadata)


def notebook_file(cells: list[Any], metadata: dict[str, Any], identity: str) -> bytes:
    """The bytes of a notebook with these cells, for Python.

    The ids of its cells follow from `identity`, which no other notebook shares.
    """
    for i, cell in enumerate(cells):
        digest = hashlib.sha256(f"{identity}/{i}".encode()).hexdigest()
        cell["id"] = digest[:8]  # nbformat draws a random one

    language = {"kernelspec": KERNEL, "language_info": {"name": "python"}}
    notebook = nbformat.v4.new_notebook(cells=cells, metadata=language | metadata)
    nbformat.validate(notebook)
    return (nbformat.writes(notebook) + "\n").encode("utf-8")
