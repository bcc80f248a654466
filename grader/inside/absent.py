"""Packages that are not installed here cost the cells that use them, not those that import them."""

import ast
import sys


class AbsentError(ModuleNotFoundError):
    """A package is used that is not installed here."""

    def __init__(self, package):
        message = f"the package {package} is not installed where sheets are marked"
        super().__init__(message, name=package)


class Absent:
    """Stands where a package that is not installed would, and says so when it is used."""

    def __init__(self, package):
        object.__setattr__(self, "package", package)

    def _used(self, *_, **__):
        raise AbsentError(object.__getattribute__(self, "package"))

    __getattr__ = __setattr__ = __call__ = __getitem__ = __setitem__ = _used
    __array__ = __iter__ = __len__ = __float__ = __int__ = __bool__ = __index__ = _used
    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __matmul__ = _used
    __truediv__ = __rtruediv__ = __pow__ = __neg__ = __enter__ = __str__ = _used


def package_of(error):
    """The package that an error misses; empty where it is about something else."""
    if isinstance(error, ModuleNotFoundError) and isinstance(error.name, str):
        return error.name.partition(".")[0][:80]
    return ""


def stand_ins(statement, error):
    """What an import in vain binds instead, by name.

    Raises the error where a part of a package is missing that is there, or nothing can be bound.
    """
    package = package_of(error)
    if not package or package in sys.modules:
        raise error
    names = {}
    for alias in statement.names:
        bound = alias.asname or alias.name
        if isinstance(statement, ast.Import) and not alias.asname:
            bound = alias.name.partition(".")[0]
        if bound != "*":
            names[bound] = Absent(package)
    return names
