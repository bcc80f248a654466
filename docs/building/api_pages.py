"""A page for every module that people call, from its docstrings."""

from importlib import import_module
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

FOLDER = "api"
INDEX = f"{FOLDER}/index.md"
ROOT = Path(__file__).parents[2]
ENGINE = (
    "robots", "robot", "chain", "table", "screws", "urdf", "toolbox", "any_robot", "random_chain",
    "kinematics", "jacobian", "analytic", "derivatives", "velocity", "inverse", "wrenches", "poses",
    "rotation", "partial_arms", "symbolic", "determinant", "singularity", "ellipsoids", "reach",
    "workspace", "limits", "expression", "errors",
)  # fmt: skip
CONTRACT = (
    "part",
    "exercise",
    "answers",
    "questions",
    "arm",
    "draws",
    "drawing",
    "properties",
    "units",
)
MODULES = [
    *(f"solutions.{name}" for name in ENGINE),
    *(f"exercises.{name}" for name in CONTRACT),
]
INTRODUCTION = {
    "solutions": "## The engine\n\nShapes, units and frames are those of "
    "[Conventions](../conventions.md).",
    "exercises": "## Exercise files\n\nWhat an exercise file imports; "
    "[Add an exercise](../add_an_exercise.md) uses it.",
}


def on_startup(**_: Any) -> None:
    """Lays the packages out as they are installed, where mkdocs.yml looks for docstrings."""
    folder = ROOT / "build" / "api" / "kinegrade"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "__init__.py").touch()
    for package in INTRODUCTION:
        link = folder / package
        if not link.is_symlink():
            link.symlink_to(ROOT / package)


def names() -> list[str]:
    """The pages that are written."""
    return [INDEX, *(page(module) for module in MODULES)]


def page(module: str) -> str:
    """The page of a module."""
    return f"{FOLDER}/{module}.md"


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Adds the pages, and one that lists them."""
    files.append(File.generated(config, INDEX, content=index()))
    for module in MODULES:
        text = f"# {module}\n\n::: kinegrade.{module}\n"
        files.append(File.generated(config, page(module), content=text))
    return files


def index() -> str:
    """The list of all modules, with the first line of each."""
    blocks = ["# API"]
    for package, introduction in INTRODUCTION.items():
        modules = [module for module in MODULES if module.startswith(package)]
        rows = [f"| [`kinegrade.{name}`]({name}.md) | {first_line(name)} |" for name in modules]
        blocks += [introduction, "\n".join(["| module | |", "|---|---|", *rows])]
    return "\n\n".join(blocks)


def first_line(module: str) -> str:
    """What a module is, in its own words."""
    said = import_module(f"kinegrade.{module}").__doc__ or ""
    return said.strip().partition("\n")[0].replace("|", r"\|").replace("[", r"\[")
