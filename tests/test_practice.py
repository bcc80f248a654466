"""Sheets to practise on: a seed is all they follow from, and nothing of a graded sheet is among it."""

import json

import pytest
from answers import EXERCISES
from courses import LEVER, handed_out, make_course
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.settings.config import CourseError
from kinegrade.course.settings.roster import SAFE_NAME
from kinegrade.course.sheet.handout import read_handout
from kinegrade.course.student.check import check_file
from kinegrade.course.student.practice import DRAWN_FOR, practice, write_practice
from kinegrade.course.variants.variant import draw_record
from pypdf import PdfReader


@pytest.fixture
def here(tmp_path, monkeypatch):
    """An empty folder with one exercise of a course's own, in which the command runs."""
    (tmp_path / "exercises").mkdir()
    (tmp_path / "exercises" / "lever.py").write_text(LEVER, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_same_seed_gives_the_same_sheet_and_another_seed_another(tmp_path):
    made = [
        write_practice(practice("frames", seed), tmp_path / f"{i}.ipynb")[0]
        for i, seed in enumerate((7, 7, 8))
    ]
    first, again, other = (path.read_bytes() for path in made)
    assert first == again
    assert first != other


def test_without_a_seed_every_run_gives_another_and_says_which(here, kinegrade):
    runs = [kinegrade("practice", "lever") for _ in range(2)]
    assert [ran.code for ran in runs] == [0, 0]
    first, second = (here / ran.out.strip() for ran in runs)
    assert read_handout(first).numbers != read_handout(second).numbers
    seed = first.stem.partition("-")[2]
    assert f"--seed {seed} gives these numbers again" in runs[0].err
    assert kinegrade("practice", "lever", "--seed", seed, "-o", "again.ipynb").code == 0
    assert (here / "again.ipynb").read_bytes() == first.read_bytes()


def test_it_needs_no_course_and_leaves_nothing_but_its_file(here, kinegrade):
    before = set(here.rglob("*"))
    assert kinegrade("practice", "lever", "--seed", 1).code == 0
    assert set(here.rglob("*")) - before == {here / "lever-1.ipynb"}


def test_all_is_told_of_answers_but_the_reference_values(here, kinegrade):
    kinegrade("practice", "lever", "--seed", 1, "--solution")
    wrong = (here / "lever-1.ipynb").read_text(encoding="utf-8")
    cells = json.loads(wrong)
    for cell in cells["cells"]:
        cell["source"] = "".join(cell["source"]).replace(
            "lever_p = ...", "lever_p = [0.123, 0.456]"
        )
    (here / "lever-1.ipynb").write_text(json.dumps(cells), encoding="utf-8")
    ran = kinegrade("check", "lever-1.ipynb")
    assert ran.code == 1
    assert "✗ lever_p                      incorrect" in ran.out
    assert "everything is told but the reference values" in ran.err

    solved = kinegrade("check", "lever-1-solution.ipynb", "--sheet", "lever-1.ipynb")
    assert solved.out.count("✓") == len(solved.out.splitlines()) == 2


@pytest.mark.parametrize("slug", ["rrt", "implement_it", "puma_velocities"])
def test_the_worked_solution_of_a_seed_earns_all_of_it(slug, tmp_path):
    sheet, solution = write_practice(practice(slug, 5), tmp_path / "a.ipynb", solution=True)
    handout, remarks = check_file(solution, sheet)
    assert handout.mode == "practice"
    assert [remark for remark in remarks if not remark.ok] == []
    assert len(remarks) == len(EXERCISES[slug].asked)


def test_a_sheet_to_practise_on_may_be_a_pdf_with_its_seed(tmp_path):
    paths = write_practice(practice("cross_products", 12), tmp_path / "a.pdf", solution=True)
    texts = ["".join(page.extract_text() for page in PdfReader(path).pages) for path in paths]
    assert [path.name for path in paths] == ["a.pdf", "a-solution.pdf"]
    assert all("seed 12" in text for text in texts)
    assert "()" not in texts[0]


def test_the_sheet_says_that_nothing_is_handed_in(here):
    (path,) = write_practice(practice("lever", 3))
    heading = "".join(json.loads(path.read_bytes())["cells"][0]["source"])
    assert "**seed 3**" in heading
    assert "Nothing of this is handed in" in heading
    assert "kinegrade check lever-3.ipynb" in heading.replace("`", "") or "lever.ipynb" in heading


def test_a_file_that_is_there_is_never_overwritten(here):
    write_practice(practice("lever", 1))
    with pytest.raises(CourseError, match="is already there, and your answers may be in it"):
        write_practice(practice("lever", 1))
    with pytest.raises(CourseError, match=r"ends in .ipynb or .pdf"):
        write_practice(practice("lever", 1), here / "a.txt")


def test_exercises_of_a_course_are_found_in_the_folder_that_is_named(tmp_path, kinegrade, here):
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "pole.py").write_text(LEVER.replace("lever", "pole"), encoding="utf-8")
    ran = kinegrade("practice", "pole", "--exercises", tmp_path / "own")
    assert ran.code == 0, ran.err
    ran = kinegrade("practice", "leverr")
    assert (ran.code, "lever" in ran.err) == (1, True)


def test_no_seed_is_drawn_as_a_graded_sheet_is(tmp_path):
    """Even who guessed the secret of a course could not ask for its numbers: no sheet has that name."""
    assert not SAFE_NAME.fullmatch(DRAWN_FOR)
    secret = "seed 4711 and some more"  # noqa: S105
    course = handed_out(make_course(tmp_path, secret=secret))
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        graded = [record.numbers for record in gradebook.records("one")]
    exercise = practice("lever", 0, course.folder / "exercises").exercise
    again = [
        draw_record(secret, DRAWN_FOR, student.id, exercise, ()).numbers
        for student in course.students
    ]
    assert not [numbers for numbers in again if numbers in graded]
