# pyright: reportOptionalSubscript=false, reportArgumentType=false, reportCallIssue=false
"""Asked functions, called on what was chosen outside."""

from .absent import package_of
from .alarms import CellTimeout, limited
from .failures import failed, stopped
from .limits import MAX_SAID
from .values import PENDING, encode_result, numpy_here


class Functions:
    """Asked functions and the results of their calls, by name.

    A result is kept until another function has the name.
    """

    def __init__(self, calls, scope, seconds):
        self.calls = calls
        self.scope = scope
        self.seconds = seconds
        self.called = {}  # the function that was called under each name
        self.results = {}
        self.slow = set()

    def due(self, *, last):
        """Names that hold a function that was not called yet; after the last cell, all with one."""
        names = []
        for name in self.calls:
            function = self.scope.get(name)
            if callable(function) and (last or self.called.get(name) is not function):
                names.append(name)
        return names

    def value(self, name):
        """The results as data, those that are still to come included."""
        pending = [PENDING] * len(self.calls[name])
        return {"k": "calls", "v": self.results.get(name) or pending}

    def call(self, name):
        """Calls a function on everything that is asked, pausing after each result.

        A result of an earlier round stays where a call now fails.
        """
        function = self.scope[name]
        calls = self.calls[name]
        if self.called.get(name) is not function:
            self.called[name] = function
            self.results[name] = [PENDING] * len(calls)
            self.slow.discard(name)

        results = self.results[name]
        for i, arguments in enumerate(calls):
            result = self.result(name, i + 1, arguments)
            if result["k"] != "error" or results[i]["k"] in ("missing", "error"):
                results[i] = result
            yield

    def result(self, name, number, arguments):
        """Result of one call as data.

        After the first call that runs out of time, all others share as much again: forty loops cost
        no more than two.
        """
        seconds = self.seconds
        if name in self.slow:
            seconds /= len(self.calls[name])
        result, error = limited(max(seconds, 0.01), result_of, self.called[name], arguments)

        if isinstance(error, CellTimeout):
            self.slow.add(name)
        if error:
            said = f"call {number} {stopped(error, seconds)}"
            return failed(said[:MAX_SAID], package_of(error))
        if result["k"] == "error":
            return dict(result, v=f"call {number}: {result['v']}"[:MAX_SAID])
        if result["k"] == "missing":
            return failed(f"call {number} returned ...")
        return result


def result_of(function, arguments):
    """Result of a function as data; its arguments are its own, for it may change them."""
    np = numpy_here()
    fresh = [arrived(np, argument) for argument in arguments]
    return encode_result(function(*fresh))


def arrived(np, argument):
    """As in exercises/kinds/arguments.py: lists of numbers in equal rows are arrays."""
    if isinstance(argument, dict):
        return {name: arrived(np, value) for name, value in argument.items()}
    if not isinstance(argument, list):
        return argument
    if shape_of(argument) is not None:
        return np.array(argument, dtype=float)
    return [arrived(np, item) for item in argument]


def shape_of(value):
    """Shape of nested numbers; None where they are no array."""
    if isinstance(value, (int, float)):
        return ()
    if not isinstance(value, list):
        return None

    shapes = {shape_of(item) for item in value}
    if not shapes:
        return (0,)
    first = shapes.pop()
    if shapes or first is None:
        return None
    return (len(value), *first)
