# rockref: what you can type. Needs Python 3.11 or newer, gcc, git and make; everything else is installed into .venv.
.DEFAULT_GOAL := help
SHELL := /bin/sh
VENV := .venv
PY := $(VENV)/bin/python
# Twice quiet: errors are shown, remarks about mirrors are not.
PIP := $(PY) -m pip install -qq --disable-pip-version-check
# The first of these that runs and is new enough; `make env PYTHON=/path/to/python` chooses another.
PYTHON ?= $(shell for p in python3.11 python3.12 python3.13 python3.14 python3; do \
	  if $$p -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1; \
	  then echo $$p; break; fi; done)
# Two workers; the tests of one file stay together, so that what a file computes once is computed once. Files in their
# order: by default those with few tests would come last, and these are the long ones.
WORKERS ?= 2
BESIDE := -n $(WORKERS) --dist loadfile --no-loadscope-reorder
PYTEST := $(PY) -m pytest $(BESIDE)
# Tests start some hundred commands, and each would translate the package anew.
unexport PYTHONDONTWRITEBYTECODE
# numba, BLAS and OpenMP keep to one thread each, or two workers would fight over two cores.
export OMP_NUM_THREADS := 1
export OPENBLAS_NUM_THREADS := 1
export MKL_NUM_THREADS := 1

.PHONY: help env demo test test-all test-oldest fuzz coverage golden bench docs peers mutate audit dist lint format clean

help:  ## list the targets
	@echo 'make <target>, where <target> is one of'
	@grep -E '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):[^#]*## (.*)/\1|\2/' \
	  | while IFS='|' read -r name text; do printf '  %-10s %s\n' "$$name" "$$text"; done

env: $(VENV)/.stamp  ## make .venv with the project in it (again only when pyproject.toml changes)

$(VENV)/.stamp: pyproject.toml
	@"$(PYTHON)" -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1 || { \
	  echo 'rockref needs Python 3.11 or newer with the venv module (Debian, Ubuntu: apt install python3-venv).'; \
	  echo "Found: $$("$(or $(PYTHON),python3)" --version 2>&1). Name one with: make env PYTHON=/path/to/python3.11"; \
	  exit 2; }
	@echo "making $(VENV) with $$($(PYTHON) --version); a minute or two"
	@$(PYTHON) -m venv $(VENV)
	@$(PIP) --editable '.[fast,test]'
	@touch $@

demo: env  ## simulate the block, compare it with measured runs, write the page
	@$(VENV)/bin/rockref demo

lint: env  ## format, lint, types, and the one-way rule of the folders
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	$(VENV)/bin/mypy
	$(VENV)/bin/lint-imports --no-cache

format: env  ## let ruff format and sort what it can
	$(VENV)/bin/ruff check --fix .
	$(VENV)/bin/ruff format .

# What the tests run is compiled while lint looks at the text, and in a fresh clone the tests themselves are translated:
# workers would each do the same.
test: env  ## lint, then every test that is not slow (below 15 minutes on two cores)
	@$(PY) -m tests.compile_ahead & made=$$!; $(MAKE) --no-print-directory lint; status=$$?; \
	  if [ $$status = 0 ] && [ ! -d tests/__pycache__ ]; then $(PY) -m pytest --collect-only -qq >/dev/null 2>&1; fi; \
	  wait $$made; exit $$status
	HYPOTHESIS_PROFILE=ci $(PYTEST) -m 'not slow' $(ARGS)

test-all: lint  ## lint, then every test, then the mutants
	HYPOTHESIS_PROFILE=ci $(PYTEST) $(ARGS)
	@$(MAKE) --no-print-directory mutate

# Begun before pytest, which imports parts of the package before a plugin could look. Worker processes write files of
# their own; a test in which no file has room has none for these, either.
coverage: env  ## which branches of what is not compiled the tests take, folder by folder (ARGS="-m 'not slow'": the quick)
	$(VENV)/bin/coverage erase
	HYPOTHESIS_PROFILE=ci $(VENV)/bin/coverage run -m pytest $(BESIDE) -q --deselect \
	  tests/acceptance/test_faults.py::test_no_room_ends_with_2_and_leaves_earlier_results $(ARGS)
	$(VENV)/bin/coverage combine -q
	$(VENV)/bin/coverage json -q -o .coverage.json
	$(PY) -m tests.covered .coverage.json

golden: env  ## compute the golden files anew and say what differs (ten minutes)
	$(PY) -m golden.make

bench: env  ## measure the speeds that the README states
	$(PY) benchmarks/run.py

docs: $(VENV)/.stamp-docs  ## build the documentation into docs/_build/html
	$(PY) -m sphinx -W --keep-going -q -b html docs docs/_build/html
	@echo 'docs/_build/html/index.html'

$(VENV)/.stamp-docs: $(VENV)/.stamp
	@$(PIP) --editable '.[docs]'
	@touch $@

peers: $(VENV)/.stamp-peers  ## the same block in other people's simulators, side by side; LAMMPS over steps
	$(PY) benchmarks/peers.py
	$(PY) benchmarks/agree.py

$(VENV)/.stamp-peers: $(VENV)/.stamp
	@$(PIP) --editable '.[peers]'
	@touch $@

# From the beginning each time: mutmut keeps its verdicts when a test changes.
mutate: env  ## plant small faults in the law, the effects and the measures, count those that the tests notice, and hold the scores to their floors
	rm -rf mutants
	HYPOTHESIS_PROFILE=mutation $(VENV)/bin/mutmut run
	$(PY) -m tests.mutation

# A process a reader, one after the other; what is found is kept in .fuzz.
SECONDS ?= 360
fuzz: $(VENV)/.stamp-fuzz  ## give the readers of files and of the protocol to a coverage-guided fuzzer, SECONDS each
	$(PY) -m tests.fuzz.run $(SECONDS) $(READERS)

$(VENV)/.stamp-fuzz: $(VENV)/.stamp
	@$(PIP) --editable '.[fuzz]'
	@touch $@

# With the oldest versions that pyproject.toml allows, in an environment beside.
OLDEST := $(VENV)-oldest
test-oldest: env  ## the tests of the law, the readers and the engines with the oldest dependencies
	@$(PIP) uv
	@$(VENV)/bin/uv venv -q --clear --python $(PY) $(OLDEST)
	@$(VENV)/bin/uv pip install -q --python $(OLDEST)/bin/python --resolution lowest-direct --editable '.[fast,test]'
	HYPOTHESIS_PROFILE=ci $(OLDEST)/bin/python -m pytest -m 'not slow' -n $(WORKERS) --dist loadfile $(SMALL_TESTS)

SMALL_TESTS := tests/unit/model tests/unit/measure tests/unit/engines tests/unit/effects tests/unit/test_api.py \
  tests/unit/test_model_file.py tests/property

# Asks the package index about every package of .venv; --strict: one that it cannot answer for is no success.
audit: env  ## known weaknesses of what is installed (needs the network)
	@$(PY) -m venv $(VENV)-audit && $(VENV)-audit/bin/python -m pip install -qq --disable-pip-version-check pip-audit
	$(VENV)-audit/bin/pip-audit --strict --skip-editable --path "$$($(PY) -c 'import sysconfig as s; print(s.get_path("purelib"))')"

dist: env  ## build wheel and source archive into dist/
	@$(PIP) build
	$(PY) -m build --outdir dist .

clean:  ## remove what the other targets made
	rm -rf $(VENV) $(VENV)-oldest $(VENV)-audit .fuzz build dist docs/_build mutants demo_out .pytest_cache .mypy_cache .ruff_cache .import_linter_cache \
	  .hypothesis .coverage* htmlcov
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
