"""What the columns of exported tables are called, in the languages in which we have seen them."""

HEADINGS: dict[str, tuple[str, ...]] = {
    "number": ("identifier", "id", "identifiant", "identificador"),
    "name": (
        "full name", "fullname", "name", "student", "vollständiger name", "nom complet",
        "nombre completo",
    ),
    "ids": (
        "id number", "idnumber", "student id", "username", "sis user id", "sis login id",
        "roster_identifier", "sid", "matrikelnummer", "id-nummer", "kennung", "anmeldename",
        "numéro d'identification", "número de id",
    ),
    "email": (
        "email address", "email", "e-mail", "e-mail-adresse", "adresse de courriel",
        "adresse e-mail", "dirección de correo",
    ),
    "grade": ("grade", "bewertung", "note", "calificación"),
    "most": (
        "maximum grade", "bestwertung", "höchste bewertung", "note maximale",
        "calificación máxima",
    ),
    "received": (
        "last modified (submission)", "zuletzt geändert (abgabe)",
        "dernière modification (travail remis)", "última modificación (entrega)",
        "submission_timestamp",
    ),
    "feedback": (
        "feedback comments", "feedback als kommentar", "feedback par commentaires",
        "comentarios de retroalimentación",
    ),
    "section": ("section",),
    "user": ("github_username",),
}  # fmt: skip
"""What a column is for, to its headings in small letters."""
