"""What get_ipython() returns: magics that show do nothing, those that run code run it."""

import os

HARMLESS = {
    "alias", "alias_magic", "autoawait", "autocall", "automagic", "autoreload", "bookmark", "cat",
    "check", "clear", "cls", "code_wrap", "colors", "conda", "config", "connect_info", "cp",
    "debug", "dhist", "dirs", "doctest_mode", "ed", "edit", "gui", "hist", "history",
    "killbgscripts", "ldir", "less", "lf", "lk", "ll", "load", "load_ext", "loadpy", "logoff",
    "logon", "logstart", "logstate", "logstop", "ls", "lsmagic", "lx", "macro", "magic", "mamba",
    "man", "matplotlib", "micromamba", "mkdir", "more", "mv", "notebook", "page", "pastebin", "pdb",
    "pdef", "pdoc", "pfile", "pinfo", "pinfo2", "pip", "popd", "pprint", "precision", "psearch",
    "psource", "pushd", "pycat", "pylab", "qtconsole", "quickref", "recall", "rehashx",
    "reload_ext", "rep", "reset", "reset_selective", "rm", "rmdir", "save", "store", "sx", "system",
    "tb", "unalias", "unload_ext", "uv", "who", "whos", "xdel", "xmode",
}  # fmt: skip
SHOWN_CELLS = {
    "HTML", "SVG", "html", "javascript", "js", "latex", "markdown", "svg", "bash", "sh", "script",
    "system", "sx", "!",
}  # fmt: skip
TIMED = {"time", "timeit", "prun", "capture", "memit", "lprun"}
ENVIRONMENT = {"env", "set_env"}


class Captured:
    """What %%capture leaves: output that nobody kept."""

    stdout = stderr = ""
    outputs = ()

    def show(self):
        """Shows nothing."""

    __call__ = show


class Events:
    """Takes what libraries want to be told, and tells them nothing."""

    def register(self, _event, _function):
        """Forgets it."""

    unregister = register


class Shell:
    """The part of IPython's shell that sheets need; `run` runs code in the student's module."""

    def __init__(self, run, scope):
        self.run = run
        self.user_ns = scope
        self.events = Events()  # matplotlib asks for them

    def run_line_magic(self, name, line, *_args, **_kwargs):
        """What a line magic gives back; NameError for those that are not known here."""
        if name in HARMLESS:
            return None
        if name in ENVIRONMENT:
            return _environment(line)
        if name in TIMED:
            return self.run(_without_options(line))
        asked = {"pwd": os.getcwd, "who_ls": self._names}
        if name in asked:
            return asked[name]()
        if name == "cd":
            return os.chdir(line.strip() or os.environ["HOME"])
        if name == "run":
            return self._run_file(line)
        raise NameError(f"the magic %{name} is not run when a sheet is marked")

    magic = run_line_magic

    def run_cell_magic(self, name, line, cell):
        """The same for a magic on top of a cell; what another program would run is passed over."""
        if name in SHOWN_CELLS:
            return None
        if name in ("writefile", "file"):
            return _written(line, cell)
        if name in TIMED:
            if name == "capture":
                self._capture(line)
            return self.run(cell)
        raise NameError(f"the magic %%{name} is not run when a sheet is marked")

    def system(self, _command):
        """A shell line, such as an installation, is passed over; what depends on it says so."""

    def getoutput(self, _command, **_kwargs):
        """No lines."""
        return []

    def enable_gui(self, _name=None):
        """There is none."""

    enable_matplotlib = enable_gui

    def _names(self):
        return sorted(name for name in self.user_ns if not name.startswith("_"))

    def _capture(self, line):
        """Sets the name that a %%capture gives, among its options."""
        for word in line.split():
            if word.isidentifier():
                self.user_ns[word] = Captured()

    def _run_file(self, line):
        words = [word for word in line.split() if not word.startswith("-")]
        with open(words[0], encoding="utf-8") as file:
            return self.run(file.read())


def _without_options(line):
    """The code behind options such as -n 10."""
    words = line.split(" ")
    while words and words[0].startswith("-"):
        option = words.pop(0)
        if option in ("-n", "-r", "-p") and words:
            words.pop(0)
    return " ".join(words)


def _environment(line):
    """As %env: all variables, one, or one that is set."""
    name, equals, value = line.strip().replace(" ", "=", 1).partition("=")
    if not name:
        return dict(os.environ)
    if not equals:
        return os.environ[name]
    os.environ[name] = value
    return None


def _written(line, cell):
    words = line.split()
    mode = "a" if "-a" in words else "w"
    with open(words[-1], mode, encoding="utf-8") as file:
        file.write(cell)
