# OpenPPMC: `make help` lists the targets. scripts/targets.py is the table of targets and variables. scripts/run.py
# checks goals and variables and prints the shell text of a target, which also makes the environment (.venv).

quote = '$(subst ','\'',$1)'
goals := $(or $(MAKECMDGOALS),help)
given := $(foreach v,$(.VARIABLES),$(if $(findstring command line,$(origin $v)),$(call quote,$v=$($v))))
plan   = $(shell ./scripts/find_python.sh $(call quote,$(PYTHON)) -B -m scripts.run $(call quote,$@)\
           $(foreach goal,$(goals),$(call quote,$(goal))) $(given))
# $1 is the shell text, a line `error: …`, or empty if Python failed.
run    = $(if $(filter-out error:,$(firstword $1)),$1,$(error $(or $(subst error: ,,$1),scripts/run.py failed)))

export PATH := $(CURDIR)/.venv/bin:$(PATH)
unexport VERILATOR_ROOT
# Keep compiled Python outside the source folders: each simulation is a process that imports the tests again.
export PYTHONPYCACHEPREFIX := $(CURDIR)/build/pycache
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := help
.PHONY: FORCE
%: FORCE
	@$(call run,$(plan))
Makefile FORCE: ;
