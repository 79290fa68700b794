# Two commands for a bare machine with Python 3.11 or later, its venv module and make; `make coq` needs coqc (8.16 to 8.20) only.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin

JOBS ?= $(shell nproc)
SHARE ?= 1
PLACE ?= 0
FILES ?= 16
STORE := build/coq-store/$(PLACE)-of-$(SHARE)
STAGE ?=

.PHONY: certify test exhaust lint coq coq-store docs figure clean

certify: $(VENV)/installed
	$(BIN)/juggleproof certify --rederive

test: $(VENV)/tools
	$(BIN)/python -m pytest -n 2 --dist loadfile

# What is too long for every run: the stages whose sources changed since they were recorded, or with STAGE=NAME one.
exhaust: $(VENV)/tools
	$(BIN)/python -m tests.exhaust $(STAGE)

lint: $(VENV)/tools build/imports
	$(BIN)/ruff check .
	$(BIN)/mypy
	@! git grep -nE '^(<{7}|>{7})( |$$)' || { echo "a conflict of a merge is left unsettled"; exit 1; }

# The one import name as folders, for tools that read imports and do not ask Python: mypy, and editors.
build/imports: juggleproof
	rm -rf build/imports && mkdir -p build/imports/juggleproof
	for one in juggleproof/* benchmarks certificates proofs symbolic; do \
	  ln -s ../../../$$one build/imports/juggleproof; done

# The Coq development, all of it and in order, compiled on copies so that nothing is left beside the sources.
coq:
	@command -v coqc >/dev/null || { echo "coqc is needed: Debian's package is called coq"; exit 1; }
	@coqc --version | head -n 1
	@rm -rf build/coq && mkdir -p build && cp -r proofs/coq build
	@cd build/coq && for file in $$(grep '\.v$$' _CoqProject); do echo "coqc $$file"; coqc -q $$(grep '^-Q' _CoqProject) $$file || exit 1; done

# The stored statements as Coq lemmas, each proved by its certificate: all of them, or with SHARE=12 one in 12, with PLACE=5 another.
coq-store: $(VENV)/installed
	@command -v coqc >/dev/null || { echo "coqc is needed: Debian's package is called coq"; exit 1; }
	@rm -rf $(STORE)
	$(BIN)/python -m juggleproof.coq_store $(STORE) --share $(SHARE) --place $(PLACE) --files $(FILES)
	@$(MAKE) --no-print-directory --keep-going -j $(JOBS) $$(ls $(STORE)/*.v | sed 's/v$$/vo/')

$(STORE)/Part%.vo: $(STORE)/Part%.v $(STORE)/Prelude.vo
	cd $(STORE) && coqc -q -Q . Store Part$*.v

$(STORE)/Prelude.vo: $(STORE)/Prelude.v
	cd $(STORE) && coqc -q -Q . Store Prelude.v

# The pages of docs as a site in build/site; a broken link is an error.
docs: $(VENV)/tools
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements-docs.lock
	NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --quiet --strict

# The pictures of README and of docs; the figures of the report on white, so that it can be read on a dark page.
figure: $(VENV)/tools
	$(BIN)/juggleproof report --format figures -o build > /dev/null
	for slug in fig-trap fig-attractors; do \
	  sed '0,/fill: none/s//fill: #ffffff/' build/figures/$$slug.svg > docs/img/$$slug.svg; done
	$(BIN)/juggleproof simulate juggler --picture bifurcation -o docs/img/bifurcation.svg

# What certifying needs, and no more.
$(VENV)/installed: pyproject.toml requirements.lock
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	touch $@

# What the suite, lint and types need beside it: the tools of tests, of reports and of the part.
$(VENV)/tools: $(VENV)/installed requirements-report.lock requirements-test.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements-test.lock
	touch $@

clean:
	rm -rf $(VENV) build .pytest_cache .mypy_cache .ruff_cache .hypothesis *.egg-info
