"""Feedback: a whole page that needs nothing else, escapes everything, and never prints a reference value."""

import math
import re
from dataclasses import replace
from html import escape, unescape

import numpy as np
import pytest
from answers import EXERCISES, SLUGS, part_of, raws, raws_of, telling, variant_of, wrong
from courses import lever, make_course, sheet
from kinegrade.course.ledger.gradebook import Mark
from kinegrade.course.pages.feedback import LOST, write_feedback
from kinegrade.course.pages.own_sheet import own_questions
from kinegrade.course.pages.position import position
from kinegrade.course.pages.sentences import sentence
from kinegrade.course.results.result import Result
from kinegrade.course.results.same_numbers import tells
from kinegrade.course.settings.config import Student, read_course
from kinegrade.course.term.opinions import Opinions, answer_id
from kinegrade.course.variants.variant import Record, fingerprint
from kinegrade.exercises.exercise import (
    Choice,
    Conditions,
    Formulas,
    Function,
    Manual,
    Numbers,
    TableOf,
    references,
)
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.marking.verdict import ENTRIES_FOLLOW, Finding, Verdict, not_graded
from webpage import NASTY, Page

ADA = Student("ada", "Ada Lovelace")


@pytest.fixture
def course(tmp_path):
    return read_course(make_course(tmp_path))


def feedback(course, exercise, verdicts, student=ADA, v=None, **options):
    """The page of a sheet with one exercise; with `v`, the numbers are recorded."""
    records = {}
    if v is not None:
        answers = fingerprint(exercise, v)
        records[exercise.slug] = Record(student.id, "one", exercise.slug, 0, v, answers)
    path = write_feedback(
        course,
        sheet(exercises=(exercise.slug,)).model_copy(update=options),
        [exercise],
        Result(student, "one", tuple(verdicts)),
        records,
    )
    assert path == course.folder / "feedback" / student.id / "one.html"
    return path.read_text(encoding="utf-8")


def spoiled(exercise, seed=0):
    """A variant, its answers, all of them wrong, and the verdicts on them."""
    v = variant_of(exercise.slug, seed)
    answers = references(exercise, v)
    own = {part.variable: wrong(part, answers[part.variable], v) for part in exercise.asked}
    return v, own, mark(exercise, v, raws_of(exercise, v, own))


def test_a_page_needs_nothing_but_itself(course, exercise):
    v, _, verdicts = spoiled(exercise)
    text = feedback(course, exercise, verdicts, v=v)
    page = Page(text)
    assert not {"script", "link", "iframe", "object"} & set(page.tags)
    assert [value for name, value in page.attributes if name == "href"] == []
    pictures = [value for name, value in page.attributes if name == "src"]
    assert [src for src in pictures if not src.startswith("data:image/")] == []
    assert not re.search(r"url\((?!#)|@import", text)


def test_the_question_stands_on_the_page_with_own_numbers_and_figures(course, exercise):
    v, _, verdicts = spoiled(exercise)
    text = feedback(course, exercise, verdicts, v=v)
    question = text[text.index('<details class="question"') : text.index("</details>")]
    assert question.count("<img") + question.count('role="img"') >= len(exercise.drawings(v))
    assert "Your numbers:" in question
    assert f"<h2>{escape(exercise.title)}</h2>" in text


def test_the_question_is_read_from_the_sheet_as_it_was_handed_out(class_of_three):
    folder, exercise = class_of_three.folder, lever(class_of_three.folder)
    released = folder / "released" / "ada" / "one.ipynb"
    released.write_text(released.read_text().replace("A lever.", "A lever of old."))
    numbers = {"lever": {"L": 0.5, "q": [0.3]}}
    assert "A lever of old." in own_questions(released, [exercise], numbers)["lever"]
    released.write_bytes(b"{}")
    assert "<p>A lever.</p>" in own_questions(released, [exercise], numbers)["lever"]
    assert own_questions(released, [exercise], {}) == {}


def sections(text):
    """The sections of the parts of a page by variable."""
    found = re.findall(r'<section class="part.*?</section>', text, re.DOTALL)
    return {re.findall(r"<h3><code>(\w+)", section)[0]: section for section in found}


def said(section):
    """What a section says between the question and the answer."""
    start = section.index('<p class="soft">')
    rest = section[section.index("</p>", start) :]
    return re.findall(r"<(?:p|li|blockquote)>([^<]{4,})", rest)


def test_every_verdict_has_a_sentence(course, exercise):
    v, _, verdicts = spoiled(exercise)
    quiet = [replace(verdict, findings=(), reading="") for verdict in verdicts]
    right = mark(exercise, v, raws_of(exercise, v, references(exercise, v)))
    for found in (verdicts, quiet, right, mark(exercise, v, {})):
        for variable, section in sections(feedback(course, exercise, found)).items():
            assert said(section), variable


@pytest.mark.parametrize(
    ("right", "words"),
    [
        ([True, False, False], "1 of 3 entries are right; the others are marked ✗."),
        ([False, False, False], "none of its entries is right."),
    ],
)
def test_what_no_known_mistake_explains_is_said_kindly_and_truly(right, words):
    part = part_of(EXERCISES["three_axis"], "three_axis_dq")
    verdict = Verdict(part.variable, "incorrect", 0.0, 2.0, (), "", right, [1.0, 2.0, 3.0])
    assert words in sentence(part, verdict)
    private = replace(verdict, findings=(Finding("like ben's", private=True),))
    assert words in sentence(part, private)
    assert sentence(part, replace(verdict, findings=(Finding("A sign."),))) == ""


def test_points_are_summed_up_exercise_by_exercise(course):
    exercise = EXERCISES["rrt"]
    verdicts = [Verdict("rrt_dh", "partly", 1.25, 3), not_graded("rrt_T", 3, "Because.")]
    text = feedback(course, exercise, verdicts)
    assert f'<span class="subtotal">1.25 + ? of {exercise.points:g} points</span>' in text


def test_right_from_own_answers_has_a_mark_of_its_own(course):
    exercise = EXERCISES["rrt"]
    follows = Verdict("rrt_dh", "follows", 3, 3, right=[[True]], answer=[[0.5]])
    entries = replace(follows, status="partly", findings=(Finding(f"{ENTRIES_FOLLOW} from it."),))
    plain = replace(follows, status="partly")
    shown = [sections(feedback(course, exercise, [one]))["rrt_dh"] for one in (follows, entries)]
    assert all('from-own">' in section for section in shown)
    assert "↪ right from your own answers" in shown[0]
    assert "from-own" not in sections(feedback(course, exercise, [plain]))["rrt_dh"]


@pytest.mark.parametrize(
    ("slug", "variable", "spoil"),
    [
        ("three_axis", "three_axis_z", lambda z: -z),
        ("three_axis", "three_axis_A", lambda A: A[::-1]),
        ("three_axis", "three_axis_J", lambda J: np.roll(J, 3, axis=0)),
        ("puma_velocities", "puma_velocities_twist", lambda xi: xi[::-1]),
    ],
)
def test_a_wrong_motion_is_drawn_beside_the_arms_own(course, slug, variable, spoil):
    exercise, v = EXERCISES[slug], variant_of(slug)
    answers = references(exercise, v)
    right = mark(exercise, v, raws_of(exercise, v, answers))
    assert "sketch" not in "".join(sections(feedback(course, exercise, right, v=v)).values())
    answers[variable] = spoil(answers[variable])
    found = mark(exercise, v, raws_of(exercise, v, answers))
    drawn = sections(feedback(course, exercise, found, v=v))[variable]
    assert drawn.count('class="reference') == drawn.count('class="own') >= 1
    sketch = drawn[drawn.index("<svg") : drawn.index("</svg>")]
    assert not re.search(r"\d\.\d", sketch)  # whole pixels: it tells no numbers


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("slug", SLUGS)
@pytest.mark.parametrize("size", [1e13, 1e308])
def test_numbers_at_the_end_of_all_floats_are_shown_short_and_not_drawn(course, slug, size):
    exercise, v = EXERCISES[slug], variant_of(slug)
    answers = references(exercise, v)
    for part in exercise.asked:
        if isinstance(part.answer, Numbers):
            right = np.asarray(answers[part.variable])
            answers[part.variable] = size * np.linspace(0.5, 1.0, right.size).reshape(right.shape)
    found = mark(exercise, v, raws_of(exercise, v, answers))
    for part, verdict in zip(exercise.asked, found, strict=True):
        tells(part, verdict)  # without a warning
        assert verdict.status != "not_graded" or isinstance(part.answer, Manual)
    text = feedback(course, exercise, found, v=v)
    assert not re.search(r"\bnan\b", text)
    assert not re.search(r"\d{20}", text)
    assert LOST not in unescape(text)


def test_the_same_motion_is_drawn_once(course):
    exercise, v = EXERCISES["three_axis"], variant_of("three_axis")
    answers = references(exercise, v)
    for name in ("three_axis_z", "three_axis_B"):
        answers[name] = -answers[name]
    text = feedback(course, exercise, mark(exercise, v, raws_of(exercise, v, answers)), v=v)
    assert text.count('class="sketch"') == 1
    assert 'class="sketch"' in sections(text)["three_axis_z"]


@pytest.mark.parametrize("slug", [slug for slug in SLUGS if EXERCISES[slug].robot])
def test_the_map_shows_the_own_q_on_the_arm_that_is_drawn(course, slug):
    text = feedback(course, EXERCISES[slug], [], v=variant_of(slug))
    assert text.count('class="own-map"') == 1
    assert "your q</text>" in text


def test_the_map_speaks_the_language_of_the_sheet(course):
    text = feedback(course, EXERCISES["rrt"], [], v=variant_of("rrt"), language="de")
    assert "Ihr q</text>" in text
    assert "<title>Wo Ihr Arm singulär ist und wo Sie sind</title>" in text


@pytest.mark.parametrize("slug", ["find_the_mistake", "implement_it", "cross_products"])
def test_there_is_no_map_where_the_exercise_has_no_robot_with_one(course, slug):
    assert 'class="own-map"' not in feedback(course, EXERCISES[slug], [], v=variant_of(slug))


def test_there_is_no_map_of_another_arm_than_the_drawn_one():
    exercise, v = EXERCISES["three_axis"], variant_of("three_axis")
    assert position(exercise, v) is not None
    assert position(replace(exercise, robot="planar_3r", arm=None), v) is None
    assert position(replace(exercise, robot="scara"), v) is None
    assert position(replace(exercise, drawings=lambda _: ()), v) is None


def test_an_exercise_that_fails_since_costs_its_pictures_and_no_page(course, caplog):
    exercise, v = EXERCISES["three_axis"], variant_of("three_axis")
    answers = references(exercise, v)
    answers["three_axis_z"] = -answers["three_axis_z"]
    verdicts = mark(exercise, v, raws_of(exercise, v, answers))
    record = Record("ada", "one", exercise.slug, 0, v, fingerprint(exercise, v))

    def edited(_):
        raise ZeroDivisionError

    broken = replace(exercise, drawings=edited)
    result = Result(ADA, "one", tuple(verdicts))
    one = sheet(exercises=(exercise.slug,))
    path = write_feedback(course, one, [broken], result, {exercise.slug: record})
    text = path.read_text(encoding="utf-8")
    assert len(sections(text)) == len(exercise.asked)
    assert "<svg" not in text
    assert text.count(LOST) == 2  # once for the map, once for what was compared
    assert "This figure could not be drawn" in text
    assert "the figures of three_axis are left out of a sheet" in caplog.text


def test_the_solution_is_part_of_it_where_the_sheet_shows_it(course, exercise):
    v, _, verdicts = spoiled(exercise)
    before = feedback(course, exercise, verdicts, v=v)
    after = feedback(course, exercise, verdicts, v=v, show_solutions=True)
    assert "Worked solution" not in before
    assert after.count("<summary>Worked solution</summary>") == len(exercise.asked)
    for part in exercise.asked:
        if isinstance(part.answer, Numbers):
            code = part.answer.code(part.variable, references(exercise, v)[part.variable])
            assert escape(code, quote=False) in after.replace("&#39;", "'").replace("&#34;", '"')
    Page(after)


def cells(text):
    """Whether each cell of the matrices on a page is right, and its text."""
    found = re.findall(r'<td class="(right|wrong)(?: typed)?">([^<]*)</td>', text)
    assert len(found) == text.count("<td")
    return [(right == "right", unescape(cell)) for right, cell in found]


def count_of(part, answer):
    """How many cells an answer is shown in: one for every entry, none for what is no table."""
    if isinstance(part.answer, Function | Manual):
        return 0
    if isinstance(part.answer, TableOf):
        return 4 * len(part.answer.kinds)
    return (
        len(answer) if isinstance(part.answer, Conditions) else math.prod(np.shape(answer) or (1,))
    )


def test_the_matrices_show_the_students_own_entries_marked_right_or_wrong(course, exercise):
    v = variant_of(exercise.slug)
    answers = references(exercise, v)
    numeric = [part for part in exercise.asked if isinstance(part.answer, Numbers)]
    for part in exercise.asked:
        if part in numeric:
            answers[part.variable] = answers[part.variable].copy()
            answers[part.variable].flat[0] = 123.4567
        elif isinstance(part.answer, Formulas):
            answers[part.variable] = answers[part.variable].text()  # as typed
    own = {
        **answers,
        **{name: np.array(text) for name, text in answers.items() if isinstance(text, list)},
    }
    verdicts = mark(exercise, v, raws_of(exercise, v, answers))
    shown = cells(feedback(course, exercise, verdicts))
    assert [right for right, cell in shown if cell.startswith("123")] == [False] * len(numeric)
    assert len(shown) == sum(count_of(part, own[part.variable]) for part in exercise.asked)


def test_feedback_never_prints_a_reference_value(course, exercise):
    for seed in range(3):
        v, own, verdicts = spoiled(exercise, seed)
        page = feedback(course, exercise, verdicts, v=v)
        page = re.sub(r'<details class="question".*?</details>', "", page, flags=re.DOTALL)
        text = Page(re.sub(r"<td[^>]*>[^<]*</td>", "", page)).text  # cells hold what was handed in
        answers = references(exercise, v)
        for part in exercise.asked:
            if not isinstance(part.answer, Choice):  # its options stand on the page, all of them
                told = telling(part, answers[part.variable], v) - telling(
                    part, own[part.variable], v
                )
                assert [secret for secret in told if secret in text] == []


def block(text, variable):
    """The section of one part."""
    start = text.index(f"<code>{variable}</code>")
    return text[start : text.index("</section>", start)]


def one(course, slug, variable, raw, seed=0):
    """The section of one part on the page of a sheet on which nothing else was answered."""
    exercise, v = EXERCISES[slug], variant_of(slug, seed)
    return block(feedback(course, exercise, mark(exercise, v, raws({variable: raw}))), variable)


@pytest.mark.parametrize("right", [True, False])
def test_a_choice_is_shown_with_its_options_the_students_letter_and_whether_it_is_right(
    course, right
):
    exercise, v = EXERCISES["find_the_mistake"], variant_of("find_the_mistake")
    part = part_of(exercise, "find_the_mistake_name")
    reference = references(exercise, v)[part.variable]
    letter = reference if right else wrong(part, reference, v)
    text = one(course, exercise.slug, part.variable, letter)
    listed = Page(text[text.index("<ol") : text.index("</ol>") + len("</ol>")])
    assert listed.tags.count("li") == len(part.answer.options)
    assert cells(text) == [(right, letter)]


def test_conditions_are_shown_one_by_one(course):
    exercise, v = EXERCISES["rrt"], variant_of("rrt")
    part = part_of(exercise, "rrt_singular")
    right = [f"{condition} = 0" for condition in references(exercise, v)[part.variable]]
    text = one(course, "rrt", part.variable, [*right, "q1 - 0.123 = 0"])
    assert [ok for ok, _ in cells(text)] == [True] * len(right) + [False]
    assert cells(text)[-1][1] == "q1 - 0.123 = 0"
    assert "A condition of yours holds at postures that are not asked for." in text


def test_a_formula_that_cannot_be_read_is_shown_with_a_caret_below_the_place(course):
    text = one(course, "rrt", "rrt_det", "sin(q2) * wrong & <b>")
    (typed,) = re.findall(r'<pre tabindex="0">([^<]*)</pre>', text)
    line, caret = unescape(typed).split("\n")
    assert line == "sin(q2) * wrong & <b>"
    assert "^" in caret
    assert caret.index("^") <= len(line)
    assert re.search(r"<li>[^<]+\.<pre", text)
    assert "could not be read" in text


def test_a_function_is_told_group_by_group(course):
    exercise, v = EXERCISES["implement_it"], variant_of("implement_it")
    part = part_of(exercise, "implement_it_jacobian")
    groups = part.answer.inputs(v)
    reference = references(exercise, v)[part.variable]
    planar, *others = groups
    calls = [Raw("num", reference(*call)) for call in groups[planar]]
    calls += [
        Raw("error", f"call {i}: <b>IndexError</b>")
        for name in others
        for i, _ in enumerate(groups[name])
    ]
    text = one(course, exercise.slug, part.variable, Raw("calls", calls))
    said = [unescape(line) for line in re.findall(r"<li>([^<]*)</li>", text)]
    assert [line.partition(":")[0] for line in said[: len(groups)]] == list(groups)
    assert said[0] == f"{planar}: {len(groups[planar])} of {len(groups[planar])} right."
    for name, line in zip(others, said[1:], strict=False):
        assert line.startswith(
            f"{name}: 0 of {len(groups[name])} right; the first that is not gave: <b>"
        )
        assert "<b>IndexError</b>" in line
    assert "<table" not in text
    assert f"{part.points / len(groups):g} of {part.points:g} points" in text


def test_what_is_marked_by_hand_is_shown_with_the_rubric_and_later_with_the_comment(course):
    exercise, v = EXERCISES["implement_it"], variant_of("implement_it")
    part = part_of(exercise, "implement_it_steps")
    answer = "First <b>this</b>.\nThen that."
    verdicts = mark(exercise, v, raws({part.variable: answer}))
    waiting = block(feedback(course, exercise, verdicts), part.variable)
    assert unescape(re.findall(r"<blockquote>([^<]*)</blockquote>", waiting)[0]) == answer
    for points, text in part.answer.rubric:
        assert f"<li>{points:g}: {escape(text)}</li>" in waiting
    assert "It is marked by hand." in waiting
    assert f"– of {part.points:g} points" in waiting
    (verdict,) = [one for one in verdicts if one.part == part.variable]
    given = Mark("ada", "one", part.variable, 1.5, "Clear & short.", answer_id(verdict))
    known = {one.variable: one for one in exercise.asked}
    done = Opinions({("ada", part.variable): given}, (), known).on("ada", verdicts)
    text = block(feedback(course, exercise, done), part.variable)
    person = text[text.index('<div class="person">') : text.index("</div>")]
    assert "Your marker writes:" in person
    assert "<li>Clear &amp; short.</li>" in person
    assert '<div class="person">' not in waiting
    assert "It is marked by hand." not in text
    assert f"1.5 of {part.points:g} points" in text
    assert references(exercise, v)[part.variable][:40] not in unescape(waiting + text)


def test_names_findings_and_answers_are_escaped(course):
    exercise = EXERCISES["rrt"]
    cells = [[NASTY] * 4] * 3
    verdicts = [
        Verdict("rrt_dh", "incorrect", 0.0, 3, (Finding(NASTY),), NASTY, [[False] * 4] * 3, cells),
        not_graded("rrt_T", 3, NASTY),
    ]
    page = Page(feedback(course, exercise, verdicts, Student("ada", NASTY)))
    assert "script" not in page.tags
    assert "img" not in page.tags
    said = NASTY.replace("\ud800", "\N{REPLACEMENT CHARACTER}")
    assert page.text.count(said) == 2 + 12 + 1 + 2  # name, cells, reading, findings


def test_what_is_private_is_not_in_the_feedback(course):
    exercise = EXERCISES["rrt"]
    found = (Finding("like ben's", private=True), Finding("open"))
    page = Page(feedback(course, exercise, [Verdict("rrt_dh", "incorrect", 0.0, 3, found)]))
    assert "like ben's" not in page.text
    assert "open" in page.text


def test_what_waits_is_said_and_is_no_zero(course):
    exercise = EXERCISES["rrt"]
    verdicts = [Verdict("rrt_dh", "correct", 3.0, 3), not_graded("rrt_T", 3, "Because.")]
    page = Page(feedback(course, exercise, verdicts))
    assert "3 + ? / 6 – part of this sheet waits for your instructor" in page.text
    assert "? not graded yet, – of 3 points" in page.text
    assert "Because." in page.text
    nothing_yet = Page(feedback(course, exercise, verdicts[1:]))
    assert "not graded – part of this sheet waits for your instructor" in nothing_yet.text
