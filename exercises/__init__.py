"""The exercise contract and one file per exercise."""

if __package__ != "kinegrade.exercises":
    raise ImportError(
        "Import kinegrade.exercises, not exercises: the folder is one package of the namespace "
        "kinegrade."
    )
