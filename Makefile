# OpenPPMC. `make help` lists the targets; the environment (.venv) makes itself when a target needs it.

PARTS := ppmc104
PART  ?= ppmc104
J     ?= 2

# --- variables that may be set on the command line, per target -----------------------------------------------------
GOALS := $(or $(MAKECMDGOALS),help)
VARS_test  := T SEED CLK_HZ J
VARS_soak  := SEED COUNT J
VARS_synth := PART
VARS_trace := PART
VARS_bench := PART
SETTABLE := PYTHON $(foreach goal,$(GOALS),$(VARS_$(goal)))
GIVEN    := $(foreach v,$(.VARIABLES),$(if $(findstring command line,$(origin $v)),$v))
UNKNOWN  := $(filter-out MAKEFLAGS MAKEOVERRIDES MAKELEVEL $(SETTABLE),$(GIVEN))

ifneq ($(UNKNOWN),)
$(error $(firstword $(UNKNOWN)): `make $(firstword $(GOALS))' has no such variable (it has: $(sort $(SETTABLE))))
endif

# --- checks before anything runs: one line, nothing half done -------------------------------------------------------
quote = '$(subst ','\'',$1)'
NEED_ENV := setup demo test soak lint format synth bench trace docs
CHECKED  := $(foreach v,T PART SEED COUNT CLK_HZ J,$(if $(filter $v,$(SETTABLE)),$(if $(filter-out undefined,$(origin $v)),$(call quote,$v=$($v)))))
PROBLEM  := $(shell ./scripts/preflight.sh parts=$(PARTS) python=$(call quote,$(PYTHON)) $(CHECKED) $(if $(filter $(NEED_ENV),$(GOALS)),env))
ifneq ($(PROBLEM),)
$(error $(PROBLEM))
endif

VENV   := .venv
PY     := $(VENV)/bin/python
SIM    := $(VENV)/.requirements-sim
DEV    := $(VENV)/.requirements-dev
PYTEST := $(PY) -m pytest

export PATH := $(CURDIR)/$(VENV)/bin:$(PATH)
unexport VERILATOR_ROOT
export PYTHONDONTWRITEBYTECODE := 1

.PHONY: help setup demo test soak lint format synth bench trace waves docs clean distclean
.DEFAULT_GOAL := help

help: ## this list
	@echo 'OpenPPMC: make TARGET [VARIABLE=VALUE]'
	@echo
	@sed -n 's/^\([a-z]*\):[^#]*## \(.*\)/\1|\2/p' $(firstword $(MAKEFILE_LIST)) | awk -F'|' '{ printf "  %-10s %s\n", $$1, $$2 }'
	@echo
	@echo '  PYTHON=… names the Python (3.10 or newer) to make the environment with. Parts: $(PARTS)'

setup: $(DEV) ## make the whole environment in .venv (other targets do it when they need it)

demo: $(SIM) ## a PPMC-104 through a move: what was sent, what came back, plot and waveforms in build/demo/
	@$(PY) -m scripts.demo

test: $(SIM) ## all tests; T=name picks some, SEED=n another random seed, CLK_HZ=n one clock, J=n workers (2)
	@$(PYTEST) -n $(J) $(if $(T),-k $(call quote,$(T))) $(if $(SEED),--seed $(SEED)) $(if $(CLK_HZ),--clk-hz $(CLK_HZ)) \
	  || { code=$$?; [ $$code != 5 ] || echo 'error: no test matches' $(call quote,$(strip $(if $(T),T=$(T)) $(if $(CLK_HZ),CLK_HZ=$(CLK_HZ)))) >&2; exit $$code; }

soak: $(SIM) ## COUNT=n random hosts from SEED=n on against the golden model
	@$(PY) -m scripts.soak --seed $(or $(SEED),1) --count $(or $(COUNT),1000)

lint: $(DEV) ## verible, Verilator -Wall, read_slang and ruff; no warning passes
	@$(PY) -m scripts.lint

format: $(DEV) ## lay out RTL and Python as `make lint` wants them
	@$(PY) -m scripts.lint --fix

synth: $(DEV) ## cells and clock rate of PART=ppmc104 on iCE40 and ECP5, into docs/benchmarks.md
	@$(PY) -m scripts.synth --part $(PART)

bench: $(SIM) ## clk cycles per second of RTL and golden model, into docs/benchmarks.md
	@$(PY) -m scripts.bench --part $(PART)

trace: $(SIM) ## docs/traceability/: each rule with its tests, from the last test run; fails on a gap
	@[ -d build/trace ] || $(PYTEST) -n $(J)
	@$(PY) -m scripts.trace $(PART)

waves: ## open the demo's waveforms in GTKWave or Surfer
	@./scripts/waves.sh

docs: $(DEV) ## redraw the pictures of the manual
	@$(PY) -m scripts.docs

clean: ## remove what was built, keep the environment
	@rm -rf build .pytest_cache .ruff_cache .hypothesis
	@find . -path ./$(VENV) -prune -o -name __pycache__ -type d -print | xargs rm -rf

distclean: clean ## remove the environment as well
	@rm -rf $(VENV)

$(SIM): requirements-sim.txt scripts/bootstrap.py
	@$(call bootstrap,$(notdir $<))

$(DEV): requirements-dev.txt $(SIM)
	@$(call bootstrap,$(notdir $<))

bootstrap = python=$(PY); [ -x $$python ] || python=$$(./scripts/find_python.sh $(call quote,$(PYTHON))); $$python scripts/bootstrap.py $1
