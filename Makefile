# `make demo` shows the whole path, `make test` proves it, `make validate` proves the exercises. Each builds .venv when
# it is missing.
PYTHON ?= python3
BIN := .venv/bin

.PHONY: demo test validate clean

demo: .venv/product
	$(BIN)/kinegrade demo

test: .venv/tests
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/basedpyright
	$(BIN)/pytest -n auto

validate: .venv/product
	$(BIN)/kinegrade validate --draws 100

.venv/bin/python:
	$(PYTHON) -m venv .venv || { rm -rf .venv; echo "python3 3.11 or newer with venv is needed (Debian and Ubuntu: apt install python3-venv)"; exit 1; }

.venv/product: .venv/bin/python pyproject.toml constraints.txt
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable .
	touch $@

.venv/tests: .venv/product
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[test]'
	touch $@

clean:
	rm -rf .venv demo-course build dist *.egg-info
