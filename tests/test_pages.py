"""Pages on the disk: a page that says the same keeps its day and its bytes."""

from datetime import date

import pytest
from kinegrade.course.pages import page
from kinegrade.course.pages.page import DAY, template, write_page


@pytest.fixture
def on(monkeypatch):
    """Sets the day of today."""

    def said(year, month, day):
        class Then(date):
            @classmethod
            def today(cls):
                return cls(year, month, day)

        monkeypatch.setattr(page, "date", Then)

    return said


def test_a_page_says_when_it_was_written(tmp_path, on):
    on(2026, 3, 1)
    write_page(tmp_path / "page.html", f"<p>{DAY}</p>")
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == "<p>1 March 2026</p>"


def test_a_page_that_says_the_same_keeps_its_day_and_another_does_not(tmp_path, on):
    path = tmp_path / "page.html"
    on(2026, 3, 1)
    write_page(path, f"<p>{DAY}</p> half \ud800")
    on(2026, 12, 24)
    write_page(path, f"<p>{DAY}</p> half \ud800")
    assert "1 March 2026" in path.read_text(encoding="utf-8")
    write_page(path, f"<p>{DAY}</p> more")
    assert path.read_text(encoding="utf-8") == "<p>24 December 2026</p> more"


def test_a_page_without_a_day_is_written_when_it_changed(tmp_path):
    path = tmp_path / "page.html"
    path.write_bytes(b"\xff\xfe not ours")
    write_page(path, "one")
    write_page(path, "two")
    assert path.read_text(encoding="utf-8") == "two"


def test_templates_escape_what_they_are_given():
    html = template("robots.html").render(course="<b>", figures=[])
    assert "&lt;b&gt;" in html
    assert "<b>" not in html
