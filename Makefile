# OpenPPMC. `make help` lists the targets; the environment (.venv) makes itself when a target needs it.

comma = $(subst $() ,$(),$(foreach word,$1,$(word),))
quote = '$(subst ','\'',$1)'
# T=a,b: names that hold a or b
, := ,
any = $(call quote,$(subst $(,), or ,$1))
# Names from the table of parts, openppmc/parts.py; none without a Python, which preflight.sh then asks for.
names = $(shell for python in .venv/bin/python $(call quote,$(PYTHON)) python3; do \
          "$$python" openppmc/parts.py names $1 2>/dev/null && break; done)
# Which parts a goal has: those with such a column, or those with a top module of their own.
WITH_demo := --with demo
WITH_bench := --with demo
WITH_soak := --with soak
WITH_board := --any carrier line
WITH_bitstream := --any carrier line
WITH_flash := --any carrier line
WITH_trace := --folders
SPECIAL := $(firstword $(foreach goal,$(MAKECMDGOALS),$(if $(WITH_$(goal)),$(goal))))
PARTS := $(call names,$(or $(WITH_$(SPECIAL)),--tops))$(if $(filter soak,$(SPECIAL)), all)
PART  ?= ppmc104
# What a target that can do all parts works on: PART if it is given.
GIVEN_PART = $(if $(filter-out undefined default file,$(origin PART)),$(PART))
# Names below `devices:` of each description.
BOARDS := $(shell awk 'FNR == 1 { on = 0 } /^[^ ]/ { on = /^devices:/; next } on && /^  [^ ]/ { sub(":.*", ""); print $$1 }' /dev/null $(wildcard constraints/*/board.yml))
BOARD ?= icebreaker
HOST  ?= uart
# Hosts of PART on BOARD, from `hosts:` in the description that has the board below `devices:`.
HOSTS = $(shell awk -v board=$(call quote,$(BOARD)) -v part=$(call quote,$(PART)) '\
          FNR == 1 { here = 0 } /^[^ \#]/ { section = $$1 } \
          section == "devices:" && $$1 == board ":" { here = 1 } \
          section == "parts:" && /^  [^ ]/ { carried = $$1; sub(":.*", "", carried) } \
          section == "parts:" && $$1 == "of:" { carried = $$2 } \
          section == "parts:" && here && carried == part && $$1 == "hosts:" { gsub(/^[^[]*\[|\].*|,/, ""); print }\
          ' /dev/null $(wildcard constraints/*/board.yml))
J     ?= 2

# --- variables that may be set on the command line, per target -----------------------------------------------------
GOALS := $(or $(MAKECMDGOALS),help)
VARS_test  := T SEED CLK_HZ J WAVES INSIDE MODEL SIM_MAIN
CAMPAIGN := J SCHEDULER FRESH# variables of every campaign
VARS_soak  := SEED COUNT PART SIM_MAIN $(CAMPAIGN)
VARS_fuzz  := SEED COUNT $(CAMPAIGN)
VARS_coverage := T $(CAMPAIGN)
VARS_mutate := T COUNT QUICK $(CAMPAIGN)
VARS_nightly := COUNT SEED $(CAMPAIGN)
VARS_worker := SCHEDULER J
VARS_test-campaign := T
VARS_replay := FILE
VARS_lint  := VERILATOR
VARS_trace := PART
VARS_bench := PART
VARS_report := PART PEERS
VARS_size  := PART
VARS_test-gates := T SEED SIM_MAIN $(CAMPAIGN)
VARS_verilog := TOP PARAMS
VARS_test-verilog := T SEED SIM $(CAMPAIGN)
VARS_test-fusesoc := BOARD
VARS_test-litex := T
VARS_test-board := T J
VARS_test-web := T J
VARS_test-lab := T J
VARS_prove := T J BREAK
VARS_prove-night := J
VARS_board := SIM PART
TOP_VARS := XTAL_HZ TIMING PHASE_IDLE PHASE_ON READ_MAP BAUD RECORD# parameters of a board's top
VARS_bitstream := BOARD HOST PART SEED $(TOP_VARS)
VARS_flash := BOARD HOST PART
VARS_demo  := PART
VARS_release := SKIP ONLY
GIVEN_TOP := $(foreach v,$(TOP_VARS),$(if $(findstring command line,$(origin $v)),$v))
SETTABLE := PYTHON $(foreach goal,$(GOALS),$(VARS_$(goal)))
GIVEN    := $(foreach v,$(.VARIABLES),$(if $(findstring command line,$(origin $v)),$v))
UNKNOWN  := $(filter-out MAKEFLAGS MAKEOVERRIDES MAKELEVEL $(SETTABLE),$(GIVEN))

ifneq ($(UNKNOWN),)
$(error $(firstword $(UNKNOWN)): `make $(firstword $(GOALS))' has no such variable (it has: $(sort $(SETTABLE))))
endif

# --- checks before anything runs: one line, nothing half done -------------------------------------------------------
TARGETS  := help setup demo waves test test-board test-gates test-campaign test-web test-lab replay
TARGETS  += prove prove-night coverage mutate soak fuzz nightly scheduler worker
TARGETS  += verilog test-verilog test-fusesoc test-litex
TARGETS  += lint format trace docs site packages boards rom board bitstream flash
TARGETS  += report size bench release clean distclean
NEED_ENV := $(filter-out help waves flash clean distclean,$(TARGETS))
CHECKED  := $(foreach v,T BREAK PART BOARD HOST SEED COUNT CLK_HZ J WAVES INSIDE MODEL SIM_MAIN SCHEDULER FRESH QUICK $(GIVEN_TOP),$(if $(filter $v,$(SETTABLE)),$(if $(filter-out undefined,$(origin $v)),$(call quote,$v=$($v)))))
PROBLEM  := $(shell ./scripts/preflight.sh parts=$(call comma,$(PARTS)) boards=$(call comma,$(BOARDS)) hosts=$(if $(filter HOST,$(SETTABLE)),$(call comma,$(HOSTS))) python=$(call quote,$(PYTHON)) $(CHECKED) $(if $(filter $(NEED_ENV),$(GOALS)),env))
ifneq ($(PROBLEM),)
$(error $(PROBLEM))
endif

VENV   := .venv
PY     := $(VENV)/bin/python
ENVSIM := $(VENV)/.group-sim
ENVDEV := $(VENV)/.group-dev
ENVCAMP := $(VENV)/.group-campaign
ENVSITE := $(VENV)/.group-site
ENVREL  := $(VENV)/.group-release
ENVLAB  := $(VENV)/.group-ophyd
ENVLITEX := $(VENV)/.group-litex
# How a campaign gets its workers, and whether it takes over earlier results.
ON = -n $(J) $(if $(SCHEDULER),--scheduler $(call quote,$(SCHEDULER))) $(if $(filter 1,$(FRESH)),--fresh)
PYTEST := $(PY) -m pytest

export PATH := $(CURDIR)/$(VENV)/bin:$(PATH)
unexport VERILATOR_ROOT
# Compiled Python out of the tree: each simulation is a process that imports the tests anew.
export PYTHONPYCACHEPREFIX := $(CURDIR)/build/pycache
unexport PYTHONDONTWRITEBYTECODE

.PHONY: $(TARGETS)
.DEFAULT_GOAL := help

help: ## this list
	@echo 'OpenPPMC: make TARGET [VARIABLE=VALUE]'
	@echo
	@sed -n 's/^\([a-z-]*\):[^#]*## \(.*\)/\1|\2/p' $(firstword $(MAKEFILE_LIST)) | awk -F'|' '{ printf "  %-13s %s\n", $$1, $$2 }'
	@echo
	@echo '  PYTHON=… names the Python (3.10 or newer) to make the environment with. Parts: $(strip $(PARTS)). Boards: $(BOARDS)'

setup: $(ENVDEV) $(ENVCAMP) ## make the whole environment in .venv (other targets do it when they need it)

demo: $(ENVSIM) ## PART=ppmc104 through a move: what was sent, what came back, plot and waveforms in build/demo/
	@$(PY) -m scripts.demo --part $(PART)

test: $(ENVSIM) ## all tests; T=name picks some, SEED=n another random seed, CLK_HZ=n one clock, J=n workers (2); WAVES=1 keeps waves, INSIDE=1 shows inner signals, MODEL=1 runs directed tests on the golden model
	@$(PYTEST) -n $(J) $(if $(T),-k $(call any,$(T))) $(if $(SEED),--seed $(SEED)) $(if $(CLK_HZ),--clk-hz $(CLK_HZ))\
	  $(if $(filter 1,$(WAVES)),--waves) $(if $(filter 1,$(INSIDE)),--inside) $(if $(filter 1,$(MODEL)),--model) \
	  || { code=$$?; [ $$code != 5 ] || echo 'error: no test matches' $(call quote,$(strip $(if $(T),T=$(T)) $(if $(CLK_HZ),CLK_HZ=$(CLK_HZ)))) >&2; exit $$code; }

soak: $(ENVCAMP) ## COUNT=n random hosts from SEED=n on against the golden model, PART=all of each part; goes on where it was interrupted
	@$(PY) -m scripts.soak $(PART) --seed $(or $(SEED),1) --count $(or $(COUNT),1000) $(ON)

fuzz: $(ENVCAMP) ## COUNT=n characters from SEED=n on, good frames and bad ones, into each deframer of the RTL and of its golden model
	@$(PY) -m scripts.fuzz $(if $(SEED),--seed $(SEED)) $(if $(COUNT),--count $(COUNT)) $(ON)

scheduler: $(ENVCAMP) ## where workers of other machines meet, on port 8786; campaigns take it with SCHEDULER=tcp://host:8786
	@$(PY) -m scripts.campaign scheduler

worker: $(ENVCAMP) ## J=n workers of this checkout for SCHEDULER=tcp://host:port
	@$(PY) -m scripts.campaign worker --scheduler $(call quote,$(SCHEDULER)) -n $(J)

coverage: $(ENVCAMP) ## docs/coverage.md: lines, branches, toggles of the RTL and crosses of the sheets that `make test` reaches; T=name a sample, into build/
	@$(PY) -m scripts.coverage $(ON) $(if $(T),-k $(call quote,$(T)))

mutate: $(ENVDEV) $(ENVCAMP) ## docs/mutants.md: small faults of the RTL and whether a proof or a test fails; T=folder or file, COUNT=n of each folder; QUICK=1 first tests alone
	@$(PY) -m scripts.mutants.made $(ON) $(if $(T),-k $(call quote,$(T))) $(if $(COUNT),--count $(COUNT)) $(if $(filter 1,$(QUICK)),--quick)

nightly: $(ENVDEV) $(ENVCAMP) ## what takes hours: COUNT=n hosts of each part from SEED=n on, coverage, mutants, all netlists, proofs; goes on where it was interrupted
	@code=0; for work in 'fuzz --count 100000000' 'soak all --seed $(or $(SEED),1000000) --count $(or $(COUNT),2000)' coverage mutants.made gates; do \
	   echo "== nightly: $$work"; $(PY) -m scripts.$$work $(ON) || code=1; done; \
	 echo '== nightly: proofs'; $(PY) -m scripts.prove --night -n $(J) || code=1; exit $$code

test-campaign: $(ENVCAMP) ## the runner of campaigns: lost workers, interruption, going on
	@$(PYTEST) tests/*/campaign $(if $(T),-k $(call any,$(T)))

replay: $(ENVSIM) ## FILE=build/failures/…/recording.json on RTL and golden model: what a failing random test has left, long or short
	@$(PY) -m scripts.replay $(call quote,$(FILE))

lint: $(ENVDEV) ## verible, Verilator -Wall, read_slang, ruff, import contracts and mypy; no warning passes; VERILATOR=program instead: what we hand out, with that Verilator
	@$(PY) -m $(if $(VERILATOR),scripts.packages --try --verilator $(call quote,$(VERILATOR)),scripts.lint)

format: $(ENVDEV) ## lay out RTL and Python as `make lint` wants them
	@$(PY) -m scripts.lint --fix

bench: $(ENVSIM) ## speed of the RTL under cocotb and alone, golden model, virtual board and commands, as ratios of one run, into docs/benchmarks.md
	@$(PY) -m scripts.bench --part $(PART)

trace: $(ENVSIM) ## docs/<part>/traceability.md: each rule with its tests, from the last test run; fails on a gap
	@[ -d build/trace ] || $(PYTEST) -n $(J)
	@for part in $(or $(GIVEN_PART),$(call names,--folders)); do $(PY) -m scripts.trace $$part || exit 1; done

test-gates: $(ENVDEV) $(ENVCAMP) ## the part tests on the netlists of iCE40 and ECP5; T=quick for the sample that CI runs
	@$(PY) -m scripts.gates $(ON) $(if $(T),-k $(call quote,$(T))) $(if $(SEED),--seed $(SEED))

verilog: $(ENVDEV) ## each part, bridge and board as one file of plain Verilog-2005 in build/verilog/; TOP=ppmc104 PARAMS=CLK_HZ=50000000,… one with other parameters
	@$(PY) -m scripts.verilog $(if $(TOP),--top $(call quote,$(TOP))) $(if $(PARAMS),--params $(call quote,$(PARAMS)))

test-verilog: $(ENVDEV) $(ENVCAMP) ## the part tests on that Verilog; T=quick for the sample that CI runs; SIM=icarus in four states, without X at an output
	@$(if $(SIM),SIM_MAIN=$(call quote,$(SIM))) $(PY) -m scripts.gates --plain $(ON) $(if $(T),-k $(call quote,$(T))) $(if $(SEED),--seed $(SEED))

test-fusesoc: $(ENVDEV) ## FuseSoC and edalize build the bitstream of BOARD=… from that Verilog, in build/edalize/
	@$(PYTEST) tests/*/fusesoc && $(PY) -m scripts.packages.plain_boards $(BOARD)

test-litex: $(ENVLITEX) $(ENVDEV) ## openppmc.litex: a VexRiscv moves motors with the C driver; needs riscv64-unknown-elf-gcc, without it that is skipped
	@$(PYTEST) tests/*/litex $(if $(T),-k $(call any,$(T)))

prove: $(ENVDEV) ## prove properties of the RTL blocks (docs/proofs.md); T=name picks some, BREAK=1 breaks the RTL of each, which must be found
	@$(PY) -m scripts.prove -n $(J) $(if $(filter 1,$(BREAK)),--break) $(if $(T),$(call quote,$(T)))

prove-night: $(ENVDEV) ## all proofs, also those that take long, with whole and with broken RTL
	@$(PY) -m scripts.prove --night -n $(J) && $(PY) -m scripts.prove --night --break -n $(J)

board: $(ENVSIM) ## a virtual board on a pseudo-terminal: Verilated board top, or a line of stations (ppmc312-serial, pmc006), motor, switches; SIM='cw=20000,…'
	@$(PY) -m openppmc.sim $(addprefix part=,$(GIVEN_PART)) $(if $(SIM),$(call quote,$(SIM)))

test-board: $(ENVSIM) ## the host package on the virtual board, through pyserial, unplugging included
	@$(PYTEST) tests/*/board -n $(J) $(if $(T),-k $(call any,$(T)))

site: $(ENVSITE) ## all documents and the playground (the RTL in the browser) as build/site/html; needs Node.js
	@$(PY) -m scripts.site

test-web: $(ENVSITE) ## the playground: modules against the golden models, its engine under node, the page in Chromium if one can be had
	@rm -f build/site/figures.txt
	@$(PYTEST) tests/*/web -n $(J) $(if $(T),-k $(call any,$(T))); code=$$?; cat build/site/figures.txt 2>/dev/null; exit $$code

test-lab: $(ENVLAB) ## openppmc.ophyd: bluesky scans, limits, stops, an unplugged port on the golden models
	@$(PYTEST) tests/*/lab -n $(J) $(if $(T),-k $(call any,$(T)))

report: $(ENVDEV) ## measure size and clock rate (15 runs each) of all that has changed, into docs/sizes.json; PART=… designs with it, PEERS=folder other open designs; continues after an interruption
	@$(PY) -m scripts.size $(addprefix --part ,$(GIVEN_PART)) $(if $(PEERS),--peers $(call quote,$(PEERS)))

size: $(ENVDEV) ## compare the sizes with docs/sizes.json; more than 5 % growth fails
	@$(PY) -m scripts.size --check $(addprefix --part ,$(GIVEN_PART))

bitstream: $(ENVDEV) ## bitstream of BOARD=… (docs/boards.md: which carries which part) with PART=… and HOST=uart, bus or spi, in build/boards/; XTAL_HZ=… TIMING=… PHASE_IDLE=… as docs/boards.md says
	@$(PY) -m scripts.bitstream $(BOARD) --host $(HOST) --part $(PART) $(if $(SEED),--seed $(SEED)) \
	  $(foreach v,$(GIVEN_TOP),-G $v=$($v))

release: $(ENVDEV) $(ENVSITE) $(ENVREL) ## everything of this version into dist/, the same bytes from the same commit; trials, also of an unreleased tree: SKIP=bitstreams,site ONLY=icebreaker,ulx3s-25f-stmc
	@$(PY) -m scripts.release $(if $(SKIP),--skip $(call quote,$(SKIP))) $(if $(ONLY),--only $(call quote,$(ONLY)))

flash: ## load that bitstream into the board with openFPGALoader
	@$(PY) -m scripts.flash $(BOARD) --host $(HOST) --part $(PART)

packages: $(ENVDEV) ## write the FuseSoC cores and vendor file lists anew from rtl/files.yml
	@$(PY) -m scripts.packages

boards: $(ENVDEV) ## write tops, constraint files and tables of the FPGA boards anew from constraints/<board>/board.yml
	@$(PY) -m scripts.boards

rom: $(ENVDEV) ## assemble the planner's program of the PMC006B4 (pmc006_calc.asm) into its ROM
	@$(PY) -m scripts.pmc006.calc_rom

waves: ## open the demo's waveforms in GTKWave or Surfer
	@./scripts/waves.sh

docs: $(ENVSIM) ## redraw the pictures of the manual
	@$(PY) -m scripts.docs

clean: ## remove what was built, keep the environment
	@rm -rf build .pytest_cache .ruff_cache .hypothesis
	@find . -path ./$(VENV) -prune -o -name __pycache__ -type d -print | xargs rm -rf

distclean: clean ## remove the environment as well
	@rm -rf $(VENV) site/node_modules site/browser/node_modules

$(VENV)/.group-%: pyproject.toml requirements.lock scripts/env.py
	@python=$(PY); [ -x "$$python" ] || python=$$(./scripts/find_python.sh $(call quote,$(PYTHON))); "$$python" -m scripts.env $* && touch $@
