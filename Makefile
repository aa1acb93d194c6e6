# make demo    set up, then lint and compile the fixture level
# make test    set up, then every check and test
# make bench   set up, then the benchmarks
# make fuzz    set up, then compare sight's tiers on a million queries over the corpus
# make fresh   demo and test in an empty Debian 12 (needs root and debootstrap)

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
export PATH := $(CURDIR)/$(BIN):$(PATH)
export PIP_DISABLE_PIP_VERSION_CHECK := 1

DEBIAN := python3-venv python3-dev g++ libcgal-dev doctest-dev git
SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo)
NATIVE := CMakeLists.txt $(shell find native runtime -name '*.[ch]pp' -o -name '*.h')

.PHONY: demo test bench fuzz fresh check native-test pytest generate clean

demo: $(VENV)/built
	@fixtures/demo.sh

test: check native-test pytest

check: $(VENV)/built
	ruff check .
	ruff format --check .
	mypy
	lint-imports

native-test: $(VENV)/built
	ctest --test-dir build/native --output-on-failure

pytest: $(VENV)/built
	pytest --durations=10

bench: $(VENV)/built
	pytest benchmarks --benchmark-only --benchmark-disable-gc -s
	python -m benchmarks.bench_sight

fuzz: $(VENV)/built
	python -m benchmarks.sight_disagreement --queries 1000000

fresh:
	tests/fresh.sh

# Everything in the repository that is made from something else in it.
generate: $(VENV)/built
	python -m tools.generate

clean:
	rm -rf $(VENV) build out

$(VENV)/debian: Makefile
	@missing=$$(for p in $(DEBIAN); do dpkg-query -W -f '$${Status}' $$p 2>/dev/null | grep -q '^install ok' || echo $$p; done); \
	if [ -n "$$missing" ]; then \
	  echo "installing $$missing"; \
	  $(SUDO) apt-get update -qq && \
	  DEBIAN_FRONTEND=noninteractive $(SUDO) apt-get install -y -qq --no-install-recommends $$missing >/dev/null; \
	fi
	@mkdir -p $(VENV) && touch $@

$(VENV)/tools: $(VENV)/debian pyproject.toml
	$(PYTHON) -m venv $(VENV)
	pip install -q 'pip>=25.1'
	pip install -q --group build --group dev
	@touch $@

$(VENV)/built: $(VENV)/tools $(NATIVE)
	pip install -q --no-build-isolation --editable . -C build-dir=build/native -C cmake.define.JKTOOLS_NATIVE_TESTS=ON
	@touch $@
