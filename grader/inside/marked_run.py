"""One notebook or script, run from top to bottom, with its answers handed over as they come."""

from .alarms import limited
from .failures import Failures, failed
from .functions import Functions
from .notebook_file import NotANotebookError, read_notebook
from .reader import Reader, hand_over
from .running import Session
from .script_file import read_script
from .values import PENDING


def run(request, notebook, write):
    """Runs all cells, with a frame before the first and after each."""
    names = request["asks"]
    seconds = request["cell_seconds"]
    try:
        read = read_script(notebook) if request["script"] else read_notebook(notebook)
    except NotANotebookError as error:
        values = {name: failed(str(error)) for name in names}
        write({"done": True, "values": values})
        return

    session = Session(with_ipython="IPython" in "".join(read.code))
    if request["script"]:
        session.stand_in(request["script"])
    functions = Functions(request["calls"], session.scope, seconds)
    reader = Reader(names, functions, seconds, read.hint)
    failures = Failures(names, seconds)
    if not read.code:
        write({"done": True, "values": reader.snapshot({})})
        return

    write({"done": False, "values": dict.fromkeys(names, PENDING)})
    for index, source in enumerate(read.code):
        _, error = limited(seconds, session.run, source)
        limited(seconds, session.close_figures)
        if error:
            failures.add(read.where(index, error), source, error)
        else:
            failures.forget(source)
        hand_over(write, reader, failures.by_name, last=index + 1 == len(read.code))
