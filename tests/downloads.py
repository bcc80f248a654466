"""Downloads and tables as other systems write them, for a class of three."""

import io
import json
import stat
import zipfile

from courses import notebook

MOODLE = """Identifier,"Full name","ID number","Email address",Status,Grade,"Maximum grade","Grade can be changed","Last modified (submission)","Last modified (grade)","Feedback comments"
"Participant 9001","Ada Lovelace",ada,ada@example.org,"Submitted for grading - Not graded",,5.00,Yes,"Monday, 23 November 2026, 11:59 PM",-,
"Participant 9002","Ben Bot",ben,ben@example.org,"Submitted for grading - 1 hour late - Not graded",,5.00,Yes,"Tuesday, 24 November 2026, 12:59 AM",-,"<p>Old, and ""kept""</p>"
"Participant 9003","Cyd, the third",cyd,cyd@example.org,"No submission - Not graded",3.50,5.00,Yes,-,-,
"""
MOODLE_GERMAN = """ID,"Vollständiger Name",E-Mail-Adresse,Status,Bewertung,Bestwertung,"Bewertung kann geändert werden","Zuletzt geändert (Abgabe)","Zuletzt geändert (Bewertung)","Feedback als Kommentar"
Teilnehmer/in9001,"Ada Lovelace",ada@example.org,"Zur Bewertung abgegeben",,"5,00",Ja,"Montag, 23. November 2026, 23:59",-,
Teilnehmer/in9002,"Ben Bot",ben@example.org,"Zur Bewertung abgegeben",,"5,00",Ja,"Dienstag, 24. November 2026, 00:59",-,
Teilnehmer/in9003,"Cyd, the third",cyd@example.org,"Keine Abgabe",,"5,00",Ja,-,-,
"""
MOODLE_FRENCH = """Identifiant,"Nom complet","Adresse de courriel",Statut,Note,"Note maximale","La note peut être modifiée","Dernière modification (travail remis)","Dernière modification (note)","Feedback par commentaires"
"Participant 9001","Ada Lovelace",ada@example.org,"Remis pour évaluation",,"5,00",Oui,"lundi 23 novembre 2026, 23:59",-,
"Participant 9002","Ben Bot",ben@example.org,"Remis pour évaluation",,"5,00",Oui,"mardi 24 novembre 2026, 00:59",-,
"Participant 9003","Cyd, the third",cyd@example.org,"Aucun devoir remis",,"5,00",Oui,-,-,
"""
MOODLE_SPANISH = """Identificador,"Nombre completo","Dirección de correo",Estado,Calificación,"Calificación máxima","La calificación puede ser cambiada","Última modificación (entrega)","Última modificación (calificación)","Comentarios de retroalimentación"
"Participante 9001","Ada Lovelace",ada@example.org,"Enviado para calificar",,"5,00",Sí,"lunes, 23 de noviembre de 2026, 23:59",-,
"Participante 9002","Ben Bot",ben@example.org,"Enviado para calificar",,"5,00",Sí,"martes, 24 de noviembre de 2026, 00:59",-,
"Participante 9003","Cyd, the third",cyd@example.org,"Sin entrega",,"5,00",Sí,-,-,
"""
MOODLE_BLIND = """Identifier,Status,Grade,"Maximum grade","Grade can be changed","Last modified (submission)","Last modified (grade)","Feedback comments"
"Participant 9001","Submitted for grading",,5.00,Yes,"Monday, 23 November 2026, 11:59 PM",-,
"Participant 9002","Submitted for grading",,5.00,Yes,"Tuesday, 24 November 2026, 12:59 AM",-,
"""
CANVAS = """Student,ID,SIS User ID,SIS Login ID,Section,Sheet one (8123),Other (8124),Final Score
    Points Possible,,,,,5,10,(read only)
"Lovelace, Ada",4711,ada,al,ROB-1,,9,90
"Bot, Ben",4712,ben,bb,ROB-1,,8,80
"third, Cyd the",4713,cyd,cc,ROB-2,4.5,7,70
"Student, Test",4799,,1f3e,ROB-1,,,0
"""
CLASSROOM = """"assignment_name","assignment_url","starter_code_url","github_username","roster_identifier","student_repository_name","student_repository_url","submission_timestamp","points_awarded","points_available"
"one","https://classroom.github.com/a/1","https://api.github.com/repos/x/one","lady-ada","ada","one-lady-ada","https://github.com/x/one-lady-ada","2026-11-23 22:59:59 UTC","0","5"
"one","https://classroom.github.com/a/1","https://api.github.com/repos/x/one","bot","ben","one-bot","https://github.com/x/one-bot","2026-11-23 23:59:59 UTC","0","5"
"""
GRADESCOPE = """---
submission_501:
  :submitters:
  - :name: Ada Lovelace
    :sid: ada
    :email: ada@example.org
  :created_at: 2026-11-23 22:59:17.123456000 Z
  :score: 10.0
  :status: processed
  :history: []
submission_502:
  :submitters:
  - :name: Ben Bot
    :sid: ben
    :email: ben@example.org
  :created_at: 2026-11-23 23:59:17.000000000 Z
  :score:
  :status: processed
  :results: !ruby/hash:ActiveSupport::HashWithIndifferentAccess
    tests: []
"""


def sheet_of(student, *sources, sheet="one"):
    """A notebook that says whose it is, as released sheets do."""
    return notebook(*sources, about={"student": student, "sheet": sheet, "mode": "graded"})


def without_metadata(student, sheet="one"):
    """A notebook of a program that dropped the metadata; its heading is still there."""
    heading = f"# Sheet one\n\nTests · sheet `{sheet}` · **A Name** (`{student}`) · 5 points"
    cells = [{"cell_type": "markdown", "metadata": {}, "source": [heading]}]
    return json.dumps({"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}).encode()


def zip_bytes(files, time=(2026, 11, 23, 12, 0, 0)):
    """A zip with these names and bytes; a value may be (bytes, time)."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            data, when = content if isinstance(content, tuple) else (content, time)
            archive.writestr(zipfile.ZipInfo(name, when), data, zipfile.ZIP_DEFLATED)
    return out.getvalue()


def zip_file(path, files):
    path.write_bytes(zip_bytes(files))
    return path


def linked(name, target):
    """The bytes of a zip in which an entry is a link."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        info = zipfile.ZipInfo(name)
        info.create_system = 3
        info.external_attr = (stat.S_IFLNK | 0o777) << 16
        archive.writestr(info, target)
    return out.getvalue()


def written(path, text, encoding="utf-8"):
    path.write_bytes(text.encode(encoding))
    return path
