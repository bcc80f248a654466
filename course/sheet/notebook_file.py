# pyright: basic
"""A notebook's file: cells and their identities, the same bytes every time."""

import hashlib
from typing import Any

import nbformat

KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}


def markdown_cell(text: str) -> Any:
    """A cell of Markdown."""
    return {"cell_type": "markdown", "id": "", "metadata": {}, "source": text}


def code_cell(source: str, answer: str = "") -> Any:
    """A cell of Python; with `answer`, the one in which that variable is asked."""
    metadata: dict[str, Any] = {}
    if answer:
        # For people and tools that keep tags; answers are collected by the variable's name. Past an
        # error in a cell with the last of them, Run All goes on.
        metadata["tags"] = ["answer", answer, "raises-exception"]
    return _python_cell(source, metadata)


def folded_cell(source: str) -> Any:
    """A cell of Python of which only the output is seen, until somebody opens it."""
    metadata: dict[str, Any] = {
        "jupyter": {"source_hidden": True},  # Jupyter and Visual Studio Code
        "tags": ["hide-input"],  # pages made of notebooks
        "cellView": "form",  # Colab
    }
    return _python_cell(source, metadata)


def _python_cell(source: str, metadata: dict[str, Any]) -> Any:
    return {
        "cell_type": "code",
        "execution_count": None,
        "id": "",
        "metadata": metadata,
        "outputs": [],
        "source": source,
    }


def notebook_file(cells: list[Any], metadata: dict[str, Any], identity: str) -> bytes:
    """The bytes of a notebook with these cells, for Python.

    The ids of its cells follow from `identity`, which no other notebook shares.
    """
    for i, cell in enumerate(cells):
        digest = hashlib.sha256(f"{identity}/{i}".encode()).hexdigest()
        cell["id"] = digest[:8]

    language = {"kernelspec": KERNEL, "language_info": {"name": "python"}}
    notebook = nbformat.v4.new_notebook(
        cells=[nbformat.from_dict(cell) for cell in cells], metadata=language | metadata
    )  # which validates all of it, once
    return (nbformat.v4.writes(notebook) + "\n").encode("utf-8")
