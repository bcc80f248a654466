"""From a roster to a marked class: sheets, gradebook, feedback, command line."""

if __package__ != "kinegrade.course":
    raise ImportError(
        "Import kinegrade.course, not course: the folder is one package of the namespace kinegrade."
    )
