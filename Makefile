# `make demo` shows the whole path, `make test` proves it, `make slow` proves what takes minutes, `make validate` proves the
# exercises, `make gallery` draws every robot into docs/gallery, `make docs` builds the documentation into site/, and
# `make density` prints how dense the code is. Each builds .venv when it is missing.
PYTHON ?= python3
BIN := .venv/bin

.PHONY: demo test slow validate gallery docs messages density clean

demo: .venv/product
	$(BIN)/kinegrade demo

test: .venv/tests
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/basedpyright
	$(BIN)/pytest -n auto -m "not slow"

slow: .venv/tests
	$(BIN)/pytest -n auto -m slow

validate: .venv/product
	$(BIN)/kinegrade validate --draws 100

gallery: .venv/product
	$(BIN)/python -m kinegrade.course.commands.gallery docs/gallery

docs: .venv/docs
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict --quiet
	@echo "site/index.html"

density: .venv/density
	$(BIN)/python benchmarks/density.py

# The template of all sentences of the interface, and the German catalogue brought up to it: what has no German is empty.
messages: .venv/product
	$(BIN)/pybabel extract -F course/language/babel.cfg --no-default-keywords -k _ -k gettext -k later -k phrase \
	  -k phrase_count:1,2 --no-location --sort-output -o course/language/interface.pot course
	$(BIN)/pybabel update --no-fuzzy-matching --ignore-obsolete -l de -w 100 \
	  -i course/language/interface.pot -o course/language/interface.de.po
	rm course/language/interface.pot

.venv/bin/python:
	$(PYTHON) -m venv .venv || { rm -rf .venv; echo "python3 3.11 or newer with venv is needed (Debian and Ubuntu: apt install python3-venv)"; exit 1; }

.venv/product: .venv/bin/python pyproject.toml constraints.txt
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable .
	touch $@

.venv/tests: .venv/product
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[test]'
	touch $@

.venv/docs: .venv/product
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[docs]'
	touch $@

.venv/density: .venv/bin/python pyproject.toml constraints.txt
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt radon
	touch $@

clean:
	rm -rf .venv demo-course docs/gallery site build dist *.egg-info
