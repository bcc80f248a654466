"""The reference engine: robots as data, chains, Jacobians, velocities, singularities."""

if __package__ != "kinegrade.solutions":
    raise ImportError(
        "Import kinegrade.solutions, not solutions: "
        "the folder is one package of the namespace kinegrade."
    )
