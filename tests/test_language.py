"""What students read in the language of their sheet: nothing is missing, and nothing else changes."""

import csv
import io
import json
import re
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from answers import EXERCISES, raw, raws_of, variant_of
from babel.messages.extract import extract_from_dir
from courses import handed_out, make_course
from kinegrade.course.grading.rules import rules_hash
from kinegrade.course.language.catalogues import HERE, catalogue, retelling
from kinegrade.course.language.speech import phrase, retold, speaking
from kinegrade.course.language.translated import translated
from kinegrade.course.language.untold import untold
from kinegrade.course.pages.feedback import write_feedback
from kinegrade.course.results.grades import SheetResults, grades_csv
from kinegrade.course.results.result import Result
from kinegrade.course.settings.asked import exercises_of
from kinegrade.course.settings.config import Sheet, Student
from kinegrade.course.sheet.assignment import Assignment
from kinegrade.course.sheet.notebook import handout_notebook, solution_notebook
from kinegrade.course.student.check import check_file
from kinegrade.course.text.words import points_text
from kinegrade.exercises.exercise import references
from kinegrade.exercises.files.finding import CATALOGUE
from kinegrade.grader.diagnosis import columns, known_columns, known_numbers
from kinegrade.grader.diagnosis.mistake import Known
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.marking.verdict import Finding, Verdict

ROOT = Path(__file__).parents[1]
CATALOGUES = sorted([*HERE.glob("*.po"), *CATALOGUE.glob("*.po")])
TRANSLATED = ("rrt", "three_axis")
KEYWORDS = {"phrase": None, "later": None, "_": None, "gettext": None, "phrase_count": (1, 2)}
TEMPLATES = {"trimmed": "true", "newstyle_gettext": "true"}
METHODS = [
    ("**.py", "python"),
    ("pages/templates/feedback.html", "jinja2"),
    ("pages/templates/verdict.html", "jinja2"),
]
OPTIONS = {"pages/templates/feedback.html": TEMPLATES, "pages/templates/verdict.html": TEMPLATES}
PLACES = re.compile(r"\{[a-z]\w*\}|%\([a-z_]+\)s")
UNTOUCHED = re.compile(r"\$[^$]*\$|`[^`]*`|\\[A-Za-z]+")


def own(slug):
    return CATALOGUE / f"{slug}.de.po"


def said_by_the_interface():
    found: set[str] = set()
    for _, _, message, _, _ in extract_from_dir(
        ROOT / "course", METHODS, OPTIONS, keywords=KEYWORDS
    ):
        found.add(str(message[0] if isinstance(message, tuple) else message))
    return found


def pairs(path):
    """All sentences of a catalogue with their translations, plurals apart."""
    for message in catalogue(path):
        if not message.id:
            continue
        ids, strings = message.id, message.string
        if isinstance(ids, str):
            ids, strings = (ids,), (strings,)
        yield from zip(ids, strings, strict=True)


def test_every_sentence_of_the_interface_has_german_and_no_other_stands_there():
    """`make messages` adds what is missing, empty, and takes away what is said no more."""
    listed = {
        str(one.id[0] if isinstance(one.id, tuple) else one.id)
        for one in catalogue(HERE / "interface.de.po")
    }
    assert listed - {""} == said_by_the_interface()


@pytest.mark.parametrize("path", CATALOGUES, ids=lambda path: path.name)
def test_every_translation_has_the_places_of_its_sentence(path):
    found = [*pairs(path)]
    assert len(found) > 20
    for sentence, translation in found:
        assert translation, sentence
        assert Counter(PLACES.findall(sentence)) == Counter(PLACES.findall(translation)), sentence


@pytest.mark.parametrize("slug", TRANSLATED)
def test_formulas_and_names_are_the_same_in_a_translation(slug):
    for sentence, translation in pairs(own(slug)):
        before, after = (set(UNTOUCHED.findall(text)) for text in (sentence, translation))
        assert before == after, sentence


@pytest.mark.parametrize("slug", TRANSLATED)
def test_a_translated_exercise_has_german_for_all_that_it_says(slug):
    for seed in range(12):
        assert untold(EXERCISES[slug], variant_of(slug, seed), retelling("de", (own(slug),))) == []


def test_every_known_mistake_of_any_arm_has_german():
    known = [
        one
        for module in (known_columns, known_numbers, columns)
        for one in vars(module).values()
        if isinstance(one, Known)
    ]
    assert len(known) > 30
    german = retelling("de", ())
    for one in known:
        for text in (one.sentence, one.clause):
            filled = re.sub(r"\{\w+\}", "2", text.replace("{other}", "standard"))
            assert german.untold(filled) == []
            assert german.told(filled) != filled


def spoiled(value):
    """Wrong numbers of the ways in which numbers go wrong."""
    value = np.asarray(value, dtype=float)
    yield from (-value, 1000 * value, np.round(value, 1), np.zeros((2, 7)), value * np.nan)
    if value.ndim:
        yield value[..., ::-1]
        one = value.copy()
        one.flat[-1] += 0.5
        yield one


@pytest.mark.parametrize("slug", TRANSLATED)
@pytest.mark.parametrize("seed", [0, 3])
def test_what_is_found_in_wrong_answers_has_german(slug, seed):
    exercise, v = EXERCISES[slug], variant_of(slug, seed)
    german = retelling("de", (own(slug),))
    answers = references(exercise, v)
    right = raws_of(exercise, v, answers)
    said = 0
    for part in exercise.asked:
        given = {name: answers[name] for name in part.needs}
        wrong = [raw(part.answer.declared(one.solve(v, given), v)) for one in part.mistakes]
        if hasattr(part.answer, "units"):
            wrong += map(raw, spoiled(answers[part.variable]))
        for one in wrong:
            for verdict in mark(exercise, v, {**right, part.variable: one}):
                found = [finding.text for finding in verdict.findings if not finding.private]
                for text in filter(None, [verdict.reading, *found]):
                    assert german.untold(text.partition("\n")[0]) == []
                    said += 1
    assert said > 10


@pytest.mark.parametrize(
    ("english", "german"),
    [
        (
            "Only a sign is wrong: row 1, column 2.",
            "Nur ein Vorzeichen ist falsch: Zeile 1, Spalte 2.",
        ),
        (
            "It follows from your own rrt_dh and rrt_T.",
            "Es folgt aus rrt_dh und rrt_T, wie Sie es angegeben haben.",
        ),
        (
            "Takes shape (3, 3), got (2, 7).",
            "Verlangt ist die Form (3, 3), gefunden: (2, 7).",
        ),
        (
            "Either a and d of row 1 are exchanged, or d1 is forgotten.",
            "Entweder a und d von Zeile 1 sind vertauscht, oder d1 ist vergessen.",
        ),
        (
            "Read as 2.5 m. Every sign is reversed.",
            "Gelesen als 2.5 m. Alle Vorzeichen sind umgekehrt.",
        ),
        (
            "could not be read (rrt_J stands twice in the file; only one of them can be meant)",
            "nicht lesbar (rrt_J steht zweimal in der Datei; gemeint sein kann nur eines davon)",
        ),
        (
            "the file is not CSV: a quotation mark is left open",
            "die Datei ist kein CSV: ein Anführungszeichen bleibt offen",
        ),
        (
            "takes 1 to 32 conditions, got more than 32",
            "verlangt sind 1 bis 32 Bedingungen, gefunden: mehr als 32",
        ),
        ("A sentence that nobody translated.", "A sentence that nobody translated."),
    ],
)
def test_a_finding_is_told_with_its_values(english, german):
    assert retelling("de", ()).told(english) == german
    assert retold(english) == english  # nothing is told otherwise where English is spoken


def test_a_language_ends_where_it_was_spoken():
    with speaking("de"):
        assert (phrase("Hints"), points_text(2.5), points_text(1)) == (
            "Hinweise",
            "2,5 Punkte",
            "1 Punkt",
        )
    assert (phrase("Hints"), points_text(2.5)) == ("Hints", "2.5 points")


def german_notebooks(slug):
    sheet = Sheet(name="one", exercises=(slug,), language="de")
    path = own(slug) if slug in TRANSLATED else None
    one = Assignment(translated(EXERCISES[slug], "de", path), variant_of(slug))
    about = ("Kurs", sheet, Student("ada", "Ada"), [one])
    with speaking("de", (path,) if path else ()):
        return [json.loads(made(*about)) for made in (handout_notebook, solution_notebook)]


@pytest.mark.parametrize("slug", TRANSLATED)
def test_a_german_sheet_has_no_english_and_computes_the_same(slug):
    about = ("Kurs", Sheet(name="one", exercises=(slug,)), Student("ada", "Ada"))
    english = json.loads(solution_notebook(*about, [Assignment(EXERCISES[slug], variant_of(slug))]))
    handout, solution = german_notebooks(slug)
    code = ["".join(cell["source"]) for cell in solution["cells"] if cell["cell_type"] == "code"]
    wanted = ["".join(cell["source"]) for cell in english["cells"] if cell["cell_type"] == "code"]
    assert [re.sub("#.*", "", cell) for cell in code] == [
        re.sub("#.*", "", cell) for cell in wanted
    ]
    for made in (handout, solution):
        for cell in made["cells"]:
            text = re.sub(r'src="[^"]*"|\$[^$]*\$', "", "".join(cell["source"]))
            if cell["cell_type"] == "markdown":
                assert re.findall(r"\b(?:the|with|your|which|numbers)\b", text) == []
    check = "".join(handout["cells"][-1]["source"])
    compile(check, "self_check", "exec")
    assert "noch nicht beantwortet" in check
    assert "not answered yet" not in check


def test_an_exercise_without_a_translation_says_so_on_its_sheet():
    handout, _ = german_notebooks("planar_2r")
    text = "".join(handout["cells"][2]["source"])
    assert "Diese Aufgabe ist nicht übersetzt; sie steht hier auf Englisch." in text
    assert EXERCISES["planar_2r"].title in text


def test_a_translation_beside_an_exercise_changes_no_mark(tmp_path):
    make_course(tmp_path)
    path = tmp_path / "exercises" / "lever.py"
    before = rules_hash(path)
    path.with_suffix(".de.po").write_text('msgid "A lever"\nmsgstr "Ein Hebel"\n', encoding="utf-8")
    assert rules_hash(path) == before


@pytest.fixture
def german(tmp_path):
    """A German course with an exercise of its own, and its translation."""
    make_course(tmp_path, more="", mode="practice")
    settings = tmp_path / "course.toml"
    settings.write_text(
        'language = "de"\n' + settings.read_text(encoding="utf-8"), encoding="utf-8"
    )
    header = 'msgid ""\nmsgstr "Content-Type: text/plain; charset=utf-8\\n"\n\n'
    lever = header + 'msgid "A lever"\nmsgstr "Ein Hebel"\n\nmsgid "The tip"\nmsgstr "Die Spitze"\n'
    (tmp_path / "exercises" / "lever.de.po").write_text(lever, encoding="utf-8")
    return handed_out(tmp_path)


def test_a_course_translates_exercises_of_its_own(german):
    text = (german.folder / "released" / "ada" / "one.ipynb").read_text(encoding="utf-8")
    assert "## 1. Ein Hebel (5 Punkte)" in text
    assert "Die Spitze. Geben Sie 4 Nachkommastellen an." in text


def test_a_check_speaks_the_language_of_its_sheet(german):
    handout, found = check_file(
        german.folder / "released" / "ada" / "one.ipynb", None, german.folder / "exercises"
    )
    assert [remark.text.split(":")[0] for remark in found] == ["nicht beantwortet"] * 2
    assert handout.told() == "Übungsblatt: Sie erfahren alles außer den richtigen Werten."


def test_feedback_is_german_and_the_findings_stay_as_they_were(german):
    course = german
    finding = Finding("Every sign is reversed.")
    verdict = Verdict("lever_p", "partly", 1.5, 2, (finding,), "", [True, False], [0.1, 0.2])
    result = Result(course.students[0], "one", (verdict,))
    sheet = course.sheets()[0]
    page = write_feedback(course, sheet, exercises_of(course, sheet), result).read_text(
        encoding="utf-8"
    )
    assert '<html lang="de">' in page
    assert "Alle Vorzeichen sind umgekehrt." in page
    assert "teilweise richtig, 1,5 von 2 Punkten" in page
    assert "Ein Hebel" in page
    assert finding.text not in page


def test_german_spreadsheets_have_a_comma_in_numbers_and_semicolons_between_cells(german):
    course = german
    verdict = Verdict("lever_p", "partly", 1.5, 2)
    results = [Result(student, "one", (verdict,)) for student in course.students]
    sheets = [SheetResults(course.sheets()[0], [], results)]
    rows = [*csv.DictReader(io.StringIO(grades_csv(sheets, "de").lstrip("\ufeff")), delimiter=";")]
    assert rows[0]["one_points"] == "1,5"
    assert rows[0]["student"] == "ada"
    english = [*csv.DictReader(io.StringIO(grades_csv(sheets).lstrip("\ufeff")))]
    assert english[0]["one_points"] == "1.5"
