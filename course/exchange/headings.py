"""What the columns of exported tables are called, in the languages in which we have seen them."""

HEADINGS: dict[str, tuple[str, ...]] = {
    "number": (
        "identifier", "id", "identifiant", "identificador", "identificatore", "identificatie",
    ),
    "name": (
        "full name", "fullname", "name", "student", "vollständiger name", "nom complet",
        "nombre completo", "nome completo", "volledige naam",
    ),
    "ids": (
        "id number", "idnumber", "student id", "username", "sis user id", "sis login id",
        "roster_identifier", "sid", "matrikelnummer", "id-nummer", "kennung",
        "anmeldename", "numéro d'identification", "número de id", "codice identificativo",
    ),
    "email": (
        "email address", "email", "e-mail", "e-mail-adresse", "adresse de courriel",
        "adresse e-mail", "dirección de correo", "indirizzo email", "e-mailadres",
    ),
    "grade": ("grade", "bewertung", "note", "calificación", "valutazione", "cijfer", "nota"),
    "most": (
        "maximum grade", "bestwertung", "höchste bewertung", "note maximale",
        "calificación máxima", "valutazione massima", "maximumcijfer",
    ),
    "received": (
        "last modified (submission)", "zuletzt geändert (abgabe)",
        "dernière modification (travail remis)", "última modificación (entrega)",
        "ultima modifica (consegna)", "laatst gewijzigd (inzending)", "submission_timestamp",
    ),
    "feedback": (
        "feedback comments", "feedback als kommentar", "feedback par commentaires",
        "comentarios de retroalimentación", "commenti", "feedbackcommentaar",
    ),
    "section": ("section",),
    "user": ("github_username",),
    "repository": ("student_repository_name",),
}  # fmt: skip
"""What a column is for, to its headings in small letters."""
