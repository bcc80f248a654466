"""One notebook, run from top to bottom, with its answers handed over as they come."""

from .alarms import limited
from .failures import Failures, failed
from .functions import Functions
from .notebook_file import NotANotebookError, read_notebook
from .reader import Reader, hand_over
from .running import Session
from .values import PENDING


def run(request, notebook, write):
    """Runs all cells, with a frame before the first and after each."""
    names = request["asks"]
    seconds = request["cell_seconds"]
    try:
        read = read_notebook(notebook)
    except NotANotebookError as error:
        values = {name: failed(str(error)) for name in names}
        write({"done": True, "values": values})
        return

    session = Session(with_ipython="IPython" in "".join(read.code))
    functions = Functions(request["calls"], session.scope, seconds)
    reader = Reader(names, functions, seconds, read.hint)
    failures = Failures(names, seconds)
    if not read.code:
        write({"done": True, "values": reader.snapshot({})})
        return

    write({"done": False, "values": dict.fromkeys(names, PENDING)})
    for number, source in enumerate(read.code, 1):
        _, error = limited(seconds, session.run, source)
        limited(seconds, session.close_figures)
        if error:
            failures.add(number, source, error)
        else:
            failures.forget(source)
        hand_over(write, reader, failures.by_name, last=number == len(read.code))
