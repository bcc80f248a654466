"""One notebook or script, run from top to bottom, with its answers handed over as they come."""

from .alarms import limited
from .failures import Failures, failed
from .functions import Functions
from .notebook_file import NotANotebookError, read_notebook
from .reader import Reader, hand_over
from .running import Session
from .script_file import read_script
from .values import PENDING

TOO_LARGE = "the file is too large: reading it took more memory than there is for a notebook"


def run(request, notebook, write):
    """Runs all cells, with a frame before the first and after each."""
    names = request["asks"]
    seconds = request["cell_seconds"]
    try:
        read = read_script(notebook) if request["script"] else read_notebook(notebook)
    except (NotANotebookError, MemoryError) as error:
        why = TOO_LARGE if isinstance(error, MemoryError) else str(error)
        write({"done": True, "values": {name: failed(why) for name in names}})
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
