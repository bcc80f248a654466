"""Asked variables as they stand, handed over after every cell and every call."""

import json

from .alarms import CellTimeout, limited
from .failures import failed, kind_of
from .limits import MAX_FRAME
from .values import encode_asked

DUMPS = json.dumps  # bound here, so that a notebook that replaces it still hands over its answers


class Reader:
    """Reads the asked variables, and does not try again what could not be read in its time."""

    def __init__(self, names, functions, seconds, hint):
        self.names = names
        self.functions = functions
        self.seconds = seconds
        self.hint = hint  # why a name is missing, from the file
        self.slow = {}

    def snapshot(self, failures):
        """Every asked variable as data; a missing one carries the error of the cell to set it."""
        return {name: noted(self.read(name), failures.get(name)) for name in self.names}

    def read(self, name):
        """One variable as data; where there is none, with what the file says about that.

        The sheet's own blank cell sets it to `...`, which is none.
        """
        if self.functions.scope.get(name, ...) is ...:
            return {"k": "missing", "v": self.hint(name)}
        return self.read_value(name)

    def read_value(self, name):
        """A variable that is there as data."""
        value = self.functions.scope[name]
        calls = self.functions.calls.get(name)
        if calls and callable(value):
            return self.functions.value(name)
        if name in self.slow and self.slow[name] is value:
            return self.too_slow()

        found, error = limited(self.seconds, encode_asked, value, calls)
        if isinstance(error, CellTimeout):
            self.slow[name] = value
            return self.too_slow()
        if error or found is None:
            return failed(f"could not be read ({kind_of(error)})")
        return found

    def too_slow(self):
        """The value of a variable that took too long to read, such as a formula without end."""
        return failed(f"could not be read (it took longer than {self.seconds:g} s)")


def noted(value, failure):
    """A value with what its cell stopped with, which is all there is to say where it is missing."""
    if failure is None:
        return value
    said, package = failure
    if value["k"] in ("missing", "error"):
        return failed(said, package or value.get("absent", ""))
    return dict(value, note=said)


def hand_over(write, reader, failures, *, last):
    """A frame with every value as it stands, and one more after every call that is due."""
    functions = reader.functions
    values = reader.snapshot(failures)
    due = functions.due(last=last)
    write({"done": last and not due, "values": fitting(values)})

    for name in due:
        for _ in functions.call(name):
            values[name] = noted(functions.value(name), failures.get(name))
            write({"done": False, "values": fitting(values)})
    if last and due:
        write({"done": True, "values": fitting(values)})


def fitting(values):
    """As many values as one frame can hold, the largest left out first."""
    sizes = {name: len(DUMPS(value)) for name, value in values.items()}
    while sum(sizes.values()) > MAX_FRAME:
        largest = max(sizes, key=sizes.__getitem__)
        values[largest] = failed("too large to be marked together with the other answers")
        sizes[largest] = len(DUMPS(values[largest]))
    return values
