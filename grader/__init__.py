"""From a submission to a verdict."""

if __package__ != "kinegrade.grader":
    raise ImportError(
        "Import kinegrade.grader, not grader: the folder is one package of the namespace kinegrade."
    )
