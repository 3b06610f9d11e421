# Installs physexp into .venv and runs it and its tests from there. Each target installs its own requirements alone.

# The first of these that is 3.11 or 3.12 and can make a virtual environment makes .venv.
PYTHON ?= python3.11 python3.12 python3

BIN = .venv/bin
# Compiled modules are kept: the tests start hundreds of processes.
PYTEST = OMP_NUM_THREADS=1 PYTHONDONTWRITEBYTECODE= $(BIN)/python -m pytest
HOW_TO_RUN = @echo 'To run physexp: $(BIN)/physexp --help; or without the folder, after: . $(BIN)/activate'

.PHONY: help install demo test test-all soak lint docs page bench example-inspect example-openenv clean
.NOTPARALLEL: # Two installations at once would write into one environment.
.DEFAULT_GOAL = help

help: ## Show this list.
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "make %-15s  %s\n", $$1, $$2}' Makefile

install: .venv/installed-all ## Install physexp into .venv with everything that its commands can use.
	$(HOW_TO_RUN)

demo: .venv/installed-figures ## Train an agent in about a minute and compare it with the ideal experimenter.
	$(BIN)/physexp demo
	$(HOW_TO_RUN)

test: lint ## Run lint and the tests.
	$(PYTEST) -n 3 --dist worksteal -m 'not long'
	$(HOW_TO_RUN)

test-all: .venv/installed-test ## Run all tests, also those that take minutes.
	$(PYTEST) -n 3 --dist worksteal

soak: .venv/installed-test ## Play every task for millions of steps (about an hour): nothing may diverge, grow or slow down.
	PHYSEXP_SOAK=1 $(PYTEST) -s tests/analysis/test_soak.py

lint: .venv/installed-test ## Run ruff and the type checker.
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy physexp

docs: .venv/installed-docs ## Build the documentation into docs/_build/html; a warning is an error. It runs the notebook.
	$(BIN)/python -m sphinx -W --keep-going -q docs docs/_build/html

page: ## Build the page to play on into the package from its sources in `page`, always the same bytes; this needs node.
	cd page && npm ci --ignore-scripts && npm run build

bench: .venv/installed-all ## Measure the speed of resets, batches and training.
	$(BIN)/physexp bench

example-inspect: .venv-inspect/installed ## Play Threshold in Inspect with a scripted model, and score it.
	$(<D)/bin/python docs/examples/inspect_task.py runs/inspect
	$(<D)/bin/physexp score --records runs/inspect/records.jsonl

example-openenv: .venv-openenv/installed ## Play Threshold with OpenEnv's own client.
	$(<D)/bin/python docs/examples/openenv_server.py

clean: ## Remove .venv, builds and caches; runs stay.
	rm -rf .venv .venv-* build dist docs/_build *.egg-info .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -prune -exec rm -rf {} +

# A stamp for each extra of setup.cfg. torch goes first and with its exact version: a looser request fetches gigabytes of
# CUDA.
.venv/installed-%: setup.cfg pyproject.toml constraints.txt | $(BIN)/python
	$(BIN)/python -m pip install -c constraints.txt setuptools "$$(grep '^torch==' constraints.txt)"
	$(BIN)/python -m pip install -c constraints.txt --no-build-isolation -e '.[$*]'
	@touch $@

# Environments of their own: these libraries do not fit beside all of constraints.txt.
.venv-inspect/installed: PIN = inspect-ai==0.3.285
.venv-openenv/installed: PIN = openenv-core==0.3.0
.venv-%/installed: | $(BIN)/python
	$(BIN)/python -m venv $(@D)
	$(@D)/bin/python -m pip install "$$(grep '^torch==' constraints.txt)" $(PIN) -e .
	@touch $@

$(BIN)/python:
	@for python in $(PYTHON); do \
	    if $$python -c 'import ensurepip, sys; sys.exit(not (3, 11) <= sys.version_info < (3, 13))' 2>/dev/null; then \
	        echo "$$python -m venv .venv"; exec $$python -m venv .venv; \
	    fi; \
	done; \
	echo "No usable Python 3.11 or 3.12 among: $(PYTHON). On Debian: apt-get install python3-venv" >&2; exit 1
