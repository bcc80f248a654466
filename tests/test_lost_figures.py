"""A figure that cannot be drawn costs no sheet: a sentence stands in its place, and validate tells."""

import json
from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest
from answers import EXERCISES, variant_of
from courses import handed_out, make_course
from kinegrade.course.proof.draw import failures_of
from kinegrade.course.sheet.assignment import LOST, Assignment
from kinegrade.grader.figures.missing import missing
from kinegrade.grader.figures.raster import png
from pypdf import PdfReader

SLUG = "three_axis"


def failing(*_):
    raise ZeroDivisionError("no such link")


@pytest.fixture
def unable(monkeypatch):
    monkeypatch.setattr("kinegrade.course.sheet.assignment.draw", failing)


@pytest.mark.usefixtures("unable")
def test_sheet_and_solution_are_written_with_a_sentence_in_place_of_the_figure(tmp_path, caplog):
    folder = make_course(tmp_path / "course", exercises=(SLUG,), students=(("ada", "Ada"),))
    text = (folder / "course.toml").read_text(encoding="utf-8")
    formats = 'formats = ["ipynb", "pdf"]\n'
    (folder / "course.toml").write_text(formats + text, encoding="utf-8")
    handed_out(folder)
    cells = json.loads((folder / "released" / "ada" / "one.ipynb").read_bytes())["cells"]
    assert sum(LOST in "".join(cell["source"]) for cell in cells) == 1
    pages = PdfReader(BytesIO((folder / "released" / "ada" / "one.pdf").read_bytes())).pages
    assert "This figure could not be drawn." in " ".join(
        " ".join(page.extract_text().split()) for page in pages
    )
    assert "a figure of three_axis is left out of a sheet" in caplog.text


@pytest.mark.usefixtures("unable")
def test_a_lost_figure_keeps_its_caption_and_says_why():
    (figure,) = Assignment(EXERCISES[SLUG], variant_of(SLUG)).figures
    assert figure.caption
    assert figure.caption != LOST
    assert figure.alt.startswith(LOST)
    assert figure.lost == "ZeroDivisionError: no such link"
    assert figure.ratio == pytest.approx(64 / 380)


def test_drawings_that_fail_cost_one_figure():
    exercise = replace(EXERCISES[SLUG], drawings=failing)
    (figure,) = Assignment(exercise, variant_of(SLUG)).figures
    assert (figure.caption, figure.lost) == (LOST, "ZeroDivisionError: no such link")


@pytest.mark.usefixtures("unable")
def test_validate_finds_a_figure_that_cannot_be_drawn():
    (found,) = failures_of(EXERCISES[SLUG], variant_of(SLUG), 1)
    assert found.kind == "solution"
    assert found.sentence == "a figure cannot be drawn: ZeroDivisionError: no such link"


def test_the_sentence_is_a_picture_that_can_be_read():
    svg = missing("a < b & c", 380)
    assert "a &lt; b &amp; c" in svg
    image = png(svg, 380)
    assert image[:4] == b"\x89PNG"
    assert np.frombuffer(image, dtype=np.uint8).size > 1000
