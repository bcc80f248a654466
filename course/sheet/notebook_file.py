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
        # For people and tools that keep tags; answers are collected by the variable's name. Past an
        # error in a cell with the last of them, Run All goes on.
        metadata["tags"] = ["answer", answer, "raises-exception"]
    return nbformat.v4.new_code_cell(source, metadata=metadata)


def folded_cell(source: str) -> Any:
    """A cell of Python of which only the output is seen, until somebody opens it."""
    metadata: dict[str, Any] = {
        "jupyter": {"source_hidden": True},  # Jupyter and Visual Studio Code
        "tags": ["hide-input"],  # pages made of notebooks
        "cellView": "form",  # Colab
    }
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
