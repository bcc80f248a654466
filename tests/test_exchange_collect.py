"""Downloads of Moodle and others taken into submitted/: whose they are, when they came in, what is refused."""

import json
from random import Random

import pytest
from courses import enrol, files_of, handed_out, make_course, right_answers
from downloads import (
    CANVAS,
    CLASSROOM,
    GRADESCOPE,
    MOODLE,
    MOODLE_BLIND,
    MOODLE_FRENCH,
    MOODLE_GERMAN,
    MOODLE_SPANISH,
    linked,
    sheet_of,
    without_metadata,
    written,
    zip_bytes,
    zip_file,
)
from kinegrade.course.exchange import archive
from kinegrade.course.exchange.moments import moment, zone_named
from kinegrade.course.settings.config import read_course

ADA = "Ada Lovelace_9001_assignsubmission_file"
BEN = "Ben Bot_9002_assignsubmission_file"


@pytest.fixture
def folder(tmp_path):
    """A course whose roster has e-mail addresses."""
    course = make_course(tmp_path / "course")
    (course / "roster.csv").write_text(
        "student,name,E-mail\nada,Ada Lovelace,ada@example.org\nben,Ben Bot,ben@example.org\ncyd,Cyd the third,cyd@example.org\n"
    )
    return course


@pytest.fixture
def collect(kinegrade, folder, tmp_path):
    """Collects a zip of these files, or bytes of one."""

    def run(files, *more, worksheet=None):
        download = tmp_path / "download.zip"
        download.write_bytes(files if isinstance(files, bytes) else zip_bytes(files))
        if worksheet:
            more = (*more, "--worksheet", written(tmp_path / "w.csv", worksheet))
        return kinegrade("collect", download, "-c", folder, "--zone", "Europe/Berlin", *more)

    return run


@pytest.fixture
def timed(folder):
    """The same course, whose sheet has a deadline."""
    path = folder / "course.toml"
    path.write_text(f"{path.read_text()}deadline = 2026-11-23T23:59:00\n")
    return folder


def submitted(folder):
    return files_of(folder / "submitted")


@pytest.mark.parametrize(
    "place",
    [
        f"{ADA}/one.json",
        f"{ADA}_/one.json",
        f"{ADA}_one.json",
        f"Group A-{ADA}/one.json",
        f"Lab-2-{ADA}/Week 1/one.json",
        "LOVELACE Ada_9001_assignsubmission_file/ONE (1).json",
        "Lovelace, Adà_9001_assignsubmission_file/one-final.json",
    ],
)
def test_a_folder_of_moodle_is_that_of_its_student(collect, folder, place):
    ran = collect({place: b"{}"})
    assert (ran.code, ran.out) == (0, f"{folder / 'submitted' / 'ada' / 'one.json'}\n")
    assert submitted(folder) == {"ada/one.json": b"{}"}


@pytest.mark.parametrize("name", ["anything.ipynb", "two.ipynb", "one.txt.ipynb"])
def test_a_notebook_is_that_of_the_sheet_inside_whatever_it_is_called(collect, folder, name):
    assert collect({f"{ADA}/{name}": sheet_of("ada")}).code == 0
    assert submitted(folder) == {"ada/one.ipynb": sheet_of("ada")}


RECEIVED = """student,sheet,file,received
ada,one,one.ipynb,2026-11-23T23:59:00+01:00
ben,one,one.json,2026-11-24T00:59:00+01:00
"""


LANGUAGES = {
    "English": MOODLE,
    "German": MOODLE_GERMAN,
    "French": MOODLE_FRENCH,
    "Spanish": MOODLE_SPANISH,
}


@pytest.mark.parametrize("worksheet", LANGUAGES.values(), ids=LANGUAGES)
def test_the_worksheet_has_the_times_whatever_its_language(collect, folder, worksheet):
    ran = collect(
        {f"{ADA}/one.ipynb": sheet_of("ada"), f"{BEN}/one.json": b"{}"}, worksheet=worksheet
    )
    assert ran.code == 0
    assert submitted(folder)["received.csv"].decode() == RECEIVED


def test_without_a_worksheet_no_time_is_made_up(collect, folder):
    ran = collect({f"{ADA}/one.ipynb": sheet_of("ada")})
    assert "1 file came without a time; the times of submission stand in the grading" in ran.err
    assert "received.csv" not in submitted(folder)


def test_the_number_goes_before_the_name(collect, folder):
    ran = collect(
        {"Benny_9002_assignsubmission_file/one.json": b"{}"}, worksheet=MOODLE
    )  # a name that no roster has
    assert ran.code == 0
    assert "ben/one.json" in submitted(folder)


def test_two_people_of_one_name_are_told_apart_by_the_worksheet(collect, folder):
    enrol(folder, [("ada", "Ada Lovelace"), ("ben", "Ada Lovelace")])
    files = {f"{ADA}/one.json": b"{}", "Ada Lovelace_9002_assignsubmission_file/one.json": b"[]"}
    ran = collect(files)
    assert ran.code == 1
    assert ran.err.count("2 people of the roster are called so (ada, ben), and no id tells") == 2
    assert not (folder / "submitted").exists()
    assert collect(files, worksheet=MOODLE.replace("Ben Bot", "Ada Lovelace")).code == 0
    assert submitted(folder)["ada/one.json"] == b"{}"
    assert submitted(folder)["ben/one.json"] == b"[]"


@pytest.mark.parametrize("word", ["Participant", "Teilnehmer in", "Deelnemer"])
def test_a_blind_download_is_matched_by_the_sheet_inside(collect, folder, word):
    files = {
        f"{word}_9001_assignsubmission_file/one.ipynb": sheet_of("ada"),
        f"{word}_9002_assignsubmission_file/work.ipynb": without_metadata("ben"),
        f"{word}_9003_assignsubmission_file/one.json": b"{}",
    }
    ran = collect(files, worksheet=MOODLE_BLIND)
    assert {"ada/one.ipynb", "ben/one.ipynb"} < set(submitted(folder))
    assert "taken for ben, whose sheet is in it" in ran.err
    assert f"{word}_9003_assignsubmission_file/one.json: nobody of roster.csv" in ran.err
    assert "ben,one,one.ipynb,2026-11-24T00:59:00+01:00" in (
        submitted(folder)["received.csv"].decode()
    )


@pytest.mark.parametrize("inside", [sheet_of, without_metadata])
def test_a_sheet_of_somebody_else_is_taken_for_neither(collect, folder, inside):
    ran = collect({f"{ADA}/one.ipynb": inside("ben")})
    assert (ran.code, ran.out) == (1, "")
    assert "it came from ada, and the sheet in it is that of ben; it is taken for neither" in (
        ran.err
    )
    assert not (folder / "submitted").exists()


def test_two_people_with_the_sheet_of_one_get_neither_taken(collect, folder):
    files = {
        "Participant_9001_assignsubmission_file/one.ipynb": sheet_of("ada"),
        "Participant_9002_assignsubmission_file/one.ipynb": sheet_of("ada"),
    }
    ran = collect(files, worksheet=MOODLE_BLIND)
    assert ran.code == 1
    assert "came from different people; neither is taken" in ran.err
    assert not (folder / "submitted").exists()


def test_somebody_whom_the_worksheet_names_is_not_taken_for_another(collect, folder):
    """A stranger to the roster hands in a sheet of the roster."""
    worksheet = MOODLE.replace('"Ada Lovelace",ada,ada@example.org', '"Zoe",zoe,zoe@example.org')
    files = {"Zoe_9001_assignsubmission_file/one.ipynb": sheet_of("ben")}
    ran = collect(files, worksheet=worksheet)
    assert (ran.code, "nobody of roster.csv; it is not taken" in ran.err) == (1, True)


def test_the_worksheet_of_another_assignment_is_noticed(collect, folder):
    """Its numbers are those of other people."""
    other = MOODLE.replace("9001", "x").replace("9002", "9001").replace("x", "9002")
    ran = collect({f"{ADA}/one.json": b"{}"}, worksheet=other)
    assert ran.code == 1
    assert "is that of ben, and its name that of ada; the table may be that of another" in ran.err


def test_ids_of_several_people_are_nobodys(collect, folder):
    ran = collect({f"{ADA}/one.json": b"{}"}, worksheet=MOODLE.replace("ada@", "ben@"))
    assert ran.code == 1
    assert "several people: ada is ada, ben@example.org is ben; it is not taken" in ran.err


def test_of_two_files_the_newest_counts_and_the_other_is_named(collect, folder):
    late, early = (2026, 11, 23, 13, 0, 0), (2026, 11, 22, 13, 0, 0)
    files = {
        f"{ADA}/one (1).ipynb": (sheet_of("ada", "late = 1"), late),
        f"{ADA}/one.ipynb": (sheet_of("ada", "early = 1"), early),
    }
    ran = collect(files, worksheet=MOODLE)
    assert submitted(folder)["ada/one.ipynb"] == sheet_of("ada", "late = 1")
    assert f"{ADA}/one.ipynb: {ADA}/one (1).ipynb of the same student is newer" in ran.err


def test_a_second_download_replaces_and_keeps_what_it_replaces(collect, folder):
    collect({f"{ADA}/one.ipynb": sheet_of("ada")}, worksheet=MOODLE)
    again = collect({f"{ADA}/one.ipynb": sheet_of("ada")}, worksheet=MOODLE)
    assert (again.out, "1 unchanged" in again.err) == ("", True)
    newer = MOODLE.replace("23 November 2026, 11:59 PM", "24 November 2026, 8:00 AM")
    collect({f"{ADA}/one.json": b"{}"}, worksheet=newer)
    assert set(submitted(folder)) == {"ada/.replaced/1-one.ipynb", "ada/one.json", "received.csv"}
    assert submitted(folder)["received.csv"].decode().splitlines()[1:] == [
        "ada,one,.replaced/1-one.ipynb,2026-11-23T23:59:00+01:00",
        "ada,one,one.json,2026-11-24T08:00:00+01:00",
    ]
    ran = collect({f"{ADA}/one.ipynb": sheet_of("ada")}, worksheet=MOODLE)
    assert "older than what ada has in submitted/ (2026-11-24T08:00:00+01:00); not taken" in ran.err
    assert "ada/one.ipynb" not in submitted(folder)


def test_a_file_without_a_time_does_not_get_that_of_an_earlier_one(collect, folder):
    collect({f"{ADA}/one.ipynb": sheet_of("ada")}, worksheet=MOODLE)
    ran = collect({f"{ADA}/one.ipynb": sheet_of("ada", "late = 1")})
    assert ran.code == 1
    assert "it came without a time, and what ada has in submitted/" in ran.err
    assert submitted(folder)["ada/one.ipynb"] == sheet_of("ada")
    assert collect({f"{ADA}/one.ipynb": sheet_of("ada")}).code == 0


def test_times_that_are_there_already_are_kept(collect, folder):
    (folder / "submitted").mkdir()
    written(
        folder / "submitted" / "received.csv",
        "student,sheet,file,received\ncyd,one,one.json,2026-11-20T10:00:00+00:00\n",
    )
    collect({f"{ADA}/one.ipynb": sheet_of("ada")}, worksheet=MOODLE)
    lines = submitted(folder)["received.csv"].decode().splitlines()[1:]
    assert [line.split(",")[0] for line in lines] == ["ada", "cyd"]


def test_a_zip_of_a_student_is_opened_and_data_go_beside_the_notebook(collect, folder):
    inner = zip_bytes({"work/one.ipynb": sheet_of("ada", "import mine"), "work/mine.py": b"x = 1"})
    outer = zip_bytes({"hand_in.zip": inner, "photo.png": b"PNG", "__MACOSX/._one.ipynb": b"x"})
    ran = collect({f"{ADA}/all.zip": outer})
    assert set(submitted(folder)) == {"ada/one.ipynb", "ada/mine.py"}
    assert "all.zip/photo.png: no answers to a sheet of this course; not taken" in ran.err
    assert "MACOSX" not in ran.err


def test_a_request_is_taken_beside_the_answers_whenever_it_comes(collect, timed):
    files = {f"{ADA}/one.request.txt": b"lever_J: why?", f"{ADA}/one.json": b"{}"}
    collect(files, worksheet=MOODLE)
    assert {"ada/one.json", "ada/one.request.txt"} < set(submitted(timed))
    assert collect({f"{ADA}/one.request (1).txt": b"lever_J: so!"}).out == ""
    collect({f"{ADA}/One.Request.txt": b"lever_J: so!"})
    assert submitted(timed)["ada/one.request.txt"] == b"lever_J: so!"
    assert submitted(timed)["ada/one.json"] == b"{}"


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("/etc/one.ipynb", "has an absolute path"),
        ("C:\\one.ipynb", "has an absolute path"),
        ("../../one.ipynb", "leads out of its folder"),
        (f"{ADA}/..\\..\\one.ipynb", "leads out of its folder"),
    ],
)
def test_a_path_that_leads_elsewhere_is_refused_with_a_sentence(collect, folder, name, words):
    ran = collect({name: sheet_of("ada"), f"{BEN}/one.json": b"{}"})
    assert ran.code == 1
    assert f"{words}; it is not taken" in ran.err
    assert set(submitted(folder)) == {"ben/one.json"}


NAMES = ["x" * 240 + ".py", "con.py", "a\u202eb.py", "ab:c.py", "one.py", "a\nb.py"]


@pytest.mark.parametrize("name", NAMES, ids=ascii)
def test_a_file_beside_that_cannot_be_called_so_everywhere_is_named(collect, folder, name):
    inner = zip_bytes({"one.ipynb": sheet_of("ada", f"import {name[:-3]}"), name: b"x = 1"})
    ran = collect({f"{ADA}/all.zip": inner})
    assert ran.code == 0
    assert "ada/one.ipynb" in submitted(folder)
    assert len(submitted(folder)) == 1
    assert "not taken" in ran.err


@pytest.mark.parametrize("name", [".", "//", "./.", ""])
def test_an_entry_without_a_name_costs_nobody_anything(collect, folder, name):
    collect({name: b"x", f"{ADA}/one.json": b"{}"}, "--from", "nbgrader")
    collect({name: b"x", f"{ADA}/one.json": b"{}"})
    assert set(submitted(folder)) == {"ada/one.json"}


def test_a_link_is_refused_in_a_zip_and_in_a_folder(collect, folder, kinegrade, tmp_path):
    inner = linked("one.ipynb", "/etc/passwd")
    assert (
        "'one.ipynb' is a link, or no file at all; it is not taken"
        in collect({f"{ADA}/all.zip": inner}).err
    )
    place = tmp_path / "unpacked" / ADA
    place.mkdir(parents=True)
    (place / "one.ipynb").symlink_to(folder / "secret")
    ran = kinegrade("collect", tmp_path / "unpacked", "-c", folder, "--from", "moodle")
    assert (ran.code, "is a link; it is not taken" in ran.err) == (1, True)
    assert not (folder / "submitted").exists()


def test_bombs_are_refused_and_cost_nobody_else_anything(collect, folder, monkeypatch):
    monkeypatch.setattr(archive, "MOST_INNER_BYTES", 1 << 20)
    monkeypatch.setattr(archive, "MOST_INNER_FILES", 10)
    monkeypatch.setattr(archive, "MAX_NOTEBOOK", 2 << 20)
    files = {
        f"{ADA}/large.zip": zip_bytes({"one.ipynb": bytes(3 << 20)}),
        "Cyd the third_9003_assignsubmission_file/many.zip": zip_bytes(
            {f"{i}.ipynb": b"" for i in range(11)}
        ),
        "Ada Lovelace_9004_assignsubmission_file/one.json": b" " * (3 << 20),
        f"{BEN}/one.json": b"{}",
    }
    ran = collect(files)
    assert "large.zip: it unpacks to 3 MB; a hand-in may have 1 MB" in ran.err
    assert "many.zip: it holds 11 files; at most 10 are taken" in ran.err
    assert "one.json has more than 2 MB; it is not taken" in ran.err
    assert set(submitted(folder)) == {"ben/one.json"}


def test_a_size_that_a_zip_lies_about_is_not_believed(collect, folder, monkeypatch):
    monkeypatch.setattr(archive, "MAX_NOTEBOOK", 1000)
    data = zip_bytes({f"{ADA}/one.json": b" " * 5000})
    told, lie = (5000).to_bytes(4, "little"), (10).to_bytes(4, "little")
    assert collect(data.replace(told, lie)).code == 1
    assert not (folder / "submitted").exists()


@pytest.mark.parametrize("data", [b"PK\x03\x04 broken", b"", b"no zip"])
def test_a_damaged_zip_of_a_student_is_named(collect, folder, data):
    ran = collect({f"{ADA}/all.zip": data, f"{BEN}/one.json": b"{}"})
    assert f"{ADA}/all.zip: a damaged zip file" in ran.err
    assert set(submitted(folder)) == {"ben/one.json"}


@pytest.mark.parametrize("seed", range(20))
def test_a_download_with_damage_in_it_is_taken_as_far_as_it_can_be(collect, folder, seed):
    """Whatever bytes are others: a sentence, and what is taken is what was handed in."""
    random = Random(seed)  # noqa: S311 - the same damage every time
    whole = [b"%d" % random.getrandbits(4000) for _ in range(3)]
    names = (ADA, BEN, "Cyd the third_9003_assignsubmission_file")
    data = bytearray(
        zip_bytes({f"{name}/one.json": one for name, one in zip(names, whole, strict=True)})
    )
    for place in random.sample(range(len(data)), 4):
        data[place] ^= 1 << random.randrange(8)
    ran = collect(bytes(data), "--from", "moodle")
    assert "our fault" not in ran.err
    taken = [one for path, one in submitted(folder).items() if path.endswith(".json")]
    assert set(taken) <= set(whole)


def test_a_notebook_of_another_sheet_or_course_is_not_taken(collect, folder):
    ran = collect({f"{ADA}/one.ipynb": sheet_of("ada", sheet="two")})
    assert "it is of sheet 'two', which this course does not have" in ran.err


def test_a_file_without_a_name_of_ours_takes_the_sheet_that_is_given(collect, folder):
    files = {f"{ADA}/solution.json": b"{}", f"{BEN}/work.ipynb": b"{}", f"{BEN}/data.csv": b"1"}
    assert collect(files).out == ""
    assert collect(files, "--sheet", "one").code == 0
    assert set(submitted(folder)) == {"ada/one.json", "ben/one.ipynb"}


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (("--sheet", "two"), "there is no sheet 'two'"),
        (("--from", "modle"), "--from takes one of moodle"),
        (("--zone", "Berlin"), "--zone takes the name of a time zone such as Europe/Berlin"),
        (("--received", "noon"), "--received takes a time such as 2026-11-23T23:59, got 'noon'"),
    ],
)
def test_what_cannot_be_meant_is_one_sentence(collect, more, words):
    ran = collect({f"{ADA}/one.json": b"{}"}, *more)
    assert ran.code == 1
    assert words in ran.err


def test_a_worksheet_in_another_language_says_what_it_looks_for(collect):
    ran = collect({f"{ADA}/one.json": b"{}"}, worksheet="Tunniste,Nimi\nOsallistuja 1,Ada\n")
    assert "no column is called identifier, id" in ran.err


def test_a_download_of_nobody_we_know_is_refused(kinegrade, folder, tmp_path):
    path = zip_file(tmp_path / "x.zip", {"one.ipynb": sheet_of("ada")})
    ran = kinegrade("collect", path, "-c", folder)
    assert "this is not known as the download of a system; --from says which" in ran.err


def test_a_download_that_is_not_there_is_told_from_a_damaged_one(kinegrade, folder, tmp_path):
    gone = kinegrade("collect", tmp_path / "nix.zip", "-c", folder)
    (tmp_path / "bad.zip").write_bytes(zip_bytes({"one.json": b"{}"})[:40])
    bad = kinegrade("collect", tmp_path / "bad.zip", "-c", folder)
    assert (gone.code, bad.code) == (1, 1)
    assert "nix.zip is not there: a download is a zip file or a folder" in gone.err
    assert "bad.zip is no zip file, or a damaged one; download it again" in bad.err


@pytest.mark.parametrize("system", ["canvas", "moodle", "nbgrader", "classroom"])
def test_a_file_that_is_called_as_no_file_of_the_system_is_named(collect, folder, system):
    ran = collect({"ada.ipynb": sheet_of("ada")}, "--from", system)
    assert (ran.code, ran.out) == (0, "")
    assert "ada.ipynb: not called as this system calls what is handed in; not taken" in ran.err
    assert "0 files taken" in ran.err


def test_files_that_are_the_systems_own_are_not_named(collect, folder):
    files = {
        "course/submitted/ada/one/one.ipynb": sheet_of("ada"),
        "course/submitted/ada/one/timestamp.txt": b"2026-11-23 22:59:59.123456 UTC",
        "source/one/one.ipynb": b"{}",
    }
    assert "not called as" not in collect(files, "--from", "nbgrader").err


def test_canvas_is_recognized_and_its_numbers_are_those_of_its_gradebook(collect, folder):
    files = {
        "lovelaceada_4711_88001_one.ipynb": sheet_of("ada"),
        "somebody_LATE_4712_88002_one-1.json": b"{}",
        "thethirdcyd_99_88003_one.json": b"[]",
    }
    ran = collect(files, worksheet=CANVAS)
    assert ran.code == 0
    assert set(submitted(folder)) == {"ada/one.ipynb", "ben/one.json", "cyd/one.json"}
    assert "Called late there: somebody_LATE_4712_88002_one-1.json" in ran.err
    assert "3 files came without a time; Canvas's download has none" in ran.err


def test_a_download_of_canvas_that_was_unpacked_and_packed_again_is_known(collect, folder):
    files = {f"submissions/{name}": data for name, data in CANVAS_FILES.items()}
    ran = collect(files, "--from", "canvas")
    assert (ran.code, set(submitted(folder))) == (0, {"ada/one.json", "ben/one.json"})
    assert "Called late there: submissions/botben_LATE_4712_88002_one.json" in ran.err


def test_canvas_where_markers_are_blind_is_matched_by_the_sheet_inside(collect, folder):
    ran = collect({"anon_Xy12z_88001_one.ipynb": sheet_of("ada"), "anon_Ab12z_8_one.json": b"{}"})
    assert (ran.code, set(submitted(folder))) == (1, {"ada/one.ipynb"})


CANVAS_FILES = {
    "lovelaceada_4711_88001_one.json": b"{}",
    "botben_LATE_4712_88002_one.json": b"{}",
}


def test_where_a_sheet_has_a_deadline_nothing_is_taken_without_a_time(collect, timed):
    """The time of the file would be that of the download, so late for everybody."""
    ran = collect(CANVAS_FILES)
    assert ran.code == 1
    assert ran.err.count("came without a time, and sheet one has a deadline; it is not taken.") == 2
    assert not (timed / "submitted").exists()


def test_one_time_can_be_given_for_all_that_are_not_called_late(collect, timed):
    ran = collect(CANVAS_FILES, "--received", "2026-11-23 23:00")
    assert ran.code == 1
    assert "A line ben,one,one.json,TIME in submitted/received.csv says when it came" in ran.err
    path = timed / "submitted" / "received.csv"
    assert path.read_text().splitlines()[1:] == ["ada,one,one.json,2026-11-23T23:00:00+01:00"]
    written(path, path.read_text() + "ben,one,one.json,2026-11-24T01:00+01:00\n")
    assert collect(CANVAS_FILES, "--received", "2026-11-23 23:00").code == 0
    assert {"ada/one.json", "ben/one.json"} < set(submitted(timed))
    assert b"ben,one,one.json,2026-11-24T01:00:00+01:00" in submitted(timed)["received.csv"]


def test_what_came_from_moodle_late_is_marked_late(collect, timed, kinegrade):
    handed_out(timed)
    path = timed / "course.toml"
    path.write_text(f"{path.read_text()}late_percent = 10\n")
    path.write_text(f'timezone = "Europe/Berlin"\n{path.read_text()}')
    answers = right_answers(read_course(timed), "ben")
    data = json.dumps({name: value.tolist() for name, value in answers.items()}).encode()
    collect({f"{BEN}/one.json": data}, worksheet=MOODLE)
    ran = kinegrade("grade", "-c", timed)
    assert "4.5 / 5" in ran.out
    assert "received.csv" not in ran.err


def test_of_two_that_were_handed_in_to_canvas_the_newest_counts(collect, folder):
    files = {
        "lovelaceada_4711_88001_one.json": (b"[1]", (2026, 11, 1, 0, 0, 0)),
        "lovelaceada_4711_88009_one-1.json": (b"[2]", (2026, 11, 2, 0, 0, 0)),
    }
    collect(files)
    assert submitted(folder)["ada/one.json"] == b"[2]"


def test_an_export_of_gradescope_has_ids_and_times(collect, folder):
    files = {
        "assignment_7_export/submission_metadata.yml": GRADESCOPE.encode(),
        "assignment_7_export/submission_501/one.ipynb": sheet_of("ada"),
        "assignment_7_export/submission_502/src/one.json": b"{}",
    }
    assert collect(files).code == 0
    assert submitted(folder)["received.csv"].decode().splitlines()[1:] == [
        "ada,one,one.ipynb,2026-11-23T22:59:17.123456+00:00",
        "ben,one,one.json,2026-11-23T23:59:17+00:00",
    ]


@pytest.mark.parametrize(
    "text", ["a: [", "- 1\n- 2", "!!python/object/apply:os.abort []", "&a [*a]"]
)
def test_metadata_of_gradescope_that_are_none_take_nothing(collect, folder, text):
    files = {"submission_metadata.yml": text.encode(), "submission_501/one.json": b"{}"}
    ran = collect(files)
    assert not (folder / "submitted").exists()
    assert "Traceback" not in ran.err


@pytest.mark.parametrize("root", ["", "submitted/", "mycourse/submitted/"])
def test_folders_of_nbgrader_have_ids_and_times(collect, folder, root):
    files = {
        f"{root}ada/one/problem.ipynb": b"{}",
        f"{root}ada/one/timestamp.txt": b"2026-11-23 22:59:59.123456 UTC",
        f"{root}ben/one/one.ipynb": sheet_of("ben"),
        f"{root}ben/one/timestamp.txt": b"2026-11-23 15:58:23.948203 America/Los_Angeles",
        f"{root}zoe/one/one.ipynb": b"{}",
    }
    ran = collect(files)
    assert f"{root}zoe/one/one.ipynb: nobody of roster.csv" in ran.err
    assert submitted(folder)["received.csv"].decode().splitlines()[1:] == [
        "ada,one,one.ipynb,2026-11-23T22:59:59+00:00",
        "ben,one,one.ipynb,2026-11-23T15:58:23-08:00",
    ]


def test_repositories_of_classroom_belong_to_the_users_of_its_table(kinegrade, folder, tmp_path):
    for user, name in (("lady-ada", "one.ipynb"), ("bot", "one.json"), ("cyd", "one.json")):
        place = tmp_path / "one-submissions" / f"one-{user}"
        (place / ".git").mkdir(parents=True)
        (place / ".git" / "one.json").write_bytes(b"no answer")
        (place / name).write_bytes(sheet_of("ada") if user == "lady-ada" else b"{}")
    table = written(tmp_path / "grades.csv", CLASSROOM)
    ran = kinegrade(
        "collect", tmp_path / "one-submissions", "--from", "classroom", "--worksheet", table,
        "-c", folder,
    )  # fmt: skip
    assert ran.code == 0
    assert set(submitted(folder)) == {
        "ada/one.ipynb",
        "ben/one.json",
        "cyd/one.json",
        "received.csv",
    }
    assert b"ben,one,one.json,2026-11-23T23:59:59+00:00" in submitted(folder)["received.csv"]


def test_repositories_of_classroom_are_found_by_its_roster_too(kinegrade, folder, tmp_path):
    roster = '"identifier","github_username","github_id","name"\n"ada","lady-ada","7",""\n'
    (tmp_path / "repos" / "one-lady-ada").mkdir(parents=True)
    (tmp_path / "repos" / "one-lady-ada" / "one.json").write_bytes(b"{}")
    table = written(tmp_path / "roster.csv", roster)
    ran = kinegrade(
        "collect", tmp_path / "repos", "--from", "classroom", "--worksheet", table, "-c", folder
    )
    assert (ran.code, set(submitted(folder))) == (0, {"ada/one.json"})


@pytest.mark.parametrize(
    ("text", "iso"),
    [
        ("Monday, 23 November 2026, 11:59 PM", "2026-11-23T23:59:00+01:00"),
        ("Monday, 23 November 2026, 12:05 AM", "2026-11-23T00:05:00+01:00"),
        ("Montag, 2. März 2026, 09:05", "2026-03-02T09:05:00+01:00"),
        ("lundi 6 juillet 2026, 23:59", "2026-07-06T23:59:00+02:00"),
        ("lunes, 3 de agosto de 2026, 23:59", "2026-08-03T23:59:00+02:00"),
        ("2026-11-23T23:59:00+05:30", "2026-11-23T23:59:00+05:30"),
        ("2026-11-23 23:59:59 UTC", "2026-11-23T23:59:59+00:00"),
        ("2026-11-23 23:59 CET", "2026-11-23T23:59:00+01:00"),
        ("2026-07-23 23:59 CEST", None),
        ("-", None),
        ("Monday, 31 February 2026, 11:59 PM", None),
        ("2026-13-45 10:00 UTC", None),
    ],
)
def test_a_time_is_read_in_the_zone_that_it_leaves_out(text, iso):
    found = moment(text, zone_named("Europe/Berlin"))
    assert (found and found.isoformat()) == iso
