# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
# Everything a fresh machine needs: Python 3.10 or newer with venv, make, and a Python package index.

PYTHON ?= python3
VENV := .venv
OLDEST := .venv-oldest
BIN := $(VENV)/bin
READY := $(VENV)/.ready
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check

# Passed on to pytest or to the demo: make test ARGS='-k gating'
ARGS ?=

# With old libraries: what computes, and the nodes as a whole. Lint and pages go by the newest ones.
OLDEST_TESTS := $(addprefix test/,tracking_core radar_tracker sonar_tracker msg_adapters tracking_session \
	nodes/test_radar_node.py nodes/test_sonar_node.py nodes/test_own_ship_and_time.py)

# A ROS installation or another environment that is active in this shell must not leak into .venv.
unexport AMENT_PREFIX_PATH LD_LIBRARY_PATH PYTHONPATH _ROS_WHEELS_BOOTSTRAP_COMPLETE

.DEFAULT_GOAL := help
.PHONY: help setup peers demo demo-sonar test oldest soak coverage lint clean

help: ## say what can be made
	@grep -E '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 12

setup: $(READY) ## make the environment .venv if it is missing or out of date

peers: $(READY) ## install what our tracks and figures are compared with
	$(PIP) --editable '.[peers]'

demo: $(READY) ## play a recorded scene through the live radar node and draw what came out
	$(BIN)/python -m tracking_tools.demo $(ARGS)

demo-sonar: $(READY) ## the same for the sonar node: bearings through a crossing
	$(BIN)/python -m tracking_tools.demo_sonar $(ARGS)

test: $(READY) ## run the whole test suite
	$(BIN)/python -m pytest --numprocesses 3 --dist worksteal $(ARGS)

oldest: $(OLDEST)/.ready ## run the tests of trackers and nodes with the oldest numpy and scipy supported
	$(OLDEST)/bin/python -m pytest --numprocesses 3 --dist worksteal $(OLDEST_TESTS) $(ARGS)

soak: $(READY) ## run the long reliability tests: an hour, on a machine that does little else
	$(BIN)/python -m pytest -m soak -s $(ARGS)

coverage: $(READY) ## run the core's tests and show which of its lines and branches they miss
	$(BIN)/python -m pytest test/tracking_core --cov=tracking_core --cov-report=term-missing --cov-fail-under=95 $(ARGS)

lint: $(READY) ## check style, types and import rules
	$(BIN)/python -m ruff check
	$(BIN)/python -m ruff format --check
	$(BIN)/python -m mypy
	$(BIN)/lint-imports

clean: ## remove the environment and all that was built
	rm -rf $(VENV) $(OLDEST) build install log dist output htmlcov .coverage .coverage.* *.egg-info
	rm -rf .hypothesis .import_linter_cache .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

$(BIN)/python:
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10) and "Python 3.10 or newer is needed")'
	$(PYTHON) -m venv --clear $(VENV) || { rm -rf $(VENV); exit 1; }

$(READY): $(BIN)/python setup.py pyproject.toml constraints.txt
	@echo 'Installing into $(VENV); this takes a few minutes the first time.'
	$(PIP) --constraint constraints.txt --editable '.[ros,tools,feeds,report,test]' \
		|| { echo 'The tested versions are not to be had here: taking others.'; $(PIP) --editable '.[ros,tools,feeds,report,test]'; }
	@touch $@

$(OLDEST)/.ready: setup.py
	$(PYTHON) -m venv --clear $(OLDEST)
	$(OLDEST)/bin/python -m pip install --quiet --disable-pip-version-check --only-binary numpy,scipy \
		'numpy == 1.26.*' 'scipy == 1.11.*' --editable '.[ros,tools,test]'
	@touch $@
