# Installs physexp into .venv, and runs what the project is for, and its tests, from there.

# The first of these that is 3.11 or newer and can make a virtual environment makes .venv.
PYTHON ?= python3.11 python3

BIN = .venv/bin
INSTALLED = .venv/installed

.PHONY: help install demo test soak lint docs bench clean
.DEFAULT_GOAL = help

help: ## Show this list.
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "make %-8s %s\n", $$1, $$2}' Makefile

install: $(INSTALLED) ## Install physexp and its tools into .venv (the other targets do it when it is needed).

demo: $(INSTALLED) ## Train an agent to find the heaviest block and compare it with random pokes.
	$(BIN)/physexp demo

test: lint ## Run lint and every test.
	OMP_NUM_THREADS=1 $(BIN)/python -m pytest -n 2 --dist worksteal

soak: $(INSTALLED) ## Play every task for millions of steps (about an hour): nothing may diverge, grow or slow down.
	PHYSEXP_SOAK=1 OMP_NUM_THREADS=1 $(BIN)/python -m pytest -s tests/analysis/test_soak.py

lint: $(INSTALLED) ## Run ruff and the type checker.
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy physexp

docs: $(INSTALLED) ## Build the documentation into docs/_build/html; a warning is an error. It runs the notebook.
	$(BIN)/python -m sphinx -W --keep-going -q docs docs/_build/html

bench: $(INSTALLED) ## Measure the speed of resets, batches and training.
	$(BIN)/physexp bench

clean: ## Remove .venv, builds and caches; runs stay.
	rm -rf .venv build dist docs/_build *.egg-info .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -prune -exec rm -rf {} +

# torch goes first and with its exact version: a looser request fetches gigabytes of CUDA.
$(INSTALLED): setup.cfg pyproject.toml constraints.txt | $(BIN)/python
	$(BIN)/python -m pip install -c constraints.txt setuptools "$$(grep '^torch==' constraints.txt)"
	$(BIN)/python -m pip install -c constraints.txt --no-build-isolation -e '.[test]'
	@touch $@

$(BIN)/python:
	@for python in $(PYTHON); do \
	    if $$python -c 'import ensurepip, sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then \
	        echo "$$python -m venv .venv"; exec $$python -m venv .venv; \
	    fi; \
	done; \
	echo "No usable Python 3.11 or newer among: $(PYTHON). On Debian: apt-get install python3-venv" >&2; exit 1
