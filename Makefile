# make demo    set up, then lint, compile and draw the fixture level
# make test    set up, then every check and test
# make bench   set up, then the benchmarks
# make fuzz    the long random tests, and a million queries each of sight and drop at two tiers
# make fresh   demo and test in an empty Debian 12 (needs root and debootstrap)

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
export PATH := $(CURDIR)/$(BIN):$(PATH)
export PIP_DISABLE_PIP_VERSION_CHECK := 1

DEBIAN := python3-venv python3-dev g++ libcgal-dev doctest-dev git
SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo)
NATIVE := CMakeLists.txt runtime/level_generated.h $(shell find native -name '*.[ch]pp')
# The editable install knows the modules that were there when it was made: a new file changes its folder's time.
FOLDERS := $(shell find jktools grammars -type d ! -name __pycache__)

.PHONY: demo test bench fuzz fresh check native-test pytest generate counts clean

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

# The rivals of the extra `bench` are measured where they can be had.
bench: $(VENV)/built
	-pip install -q --no-build-isolation --editable '.[bench]' -C build-dir=build/native -C cmake.define.JKTOOLS_NATIVE_TESTS=ON
	pytest benchmarks -s -o addopts="-q --strict-markers --import-mode=importlib"
	python -m benchmarks.bench_sight
	python -m benchmarks.bench_drop
	python -m benchmarks.bench_visibility
	python -m benchmarks.bench_ledges
	python -m benchmarks.bench_runtime

# The tests that grow with the time they are given: every corpus level, thousands of random faults, a million queries.
fuzz: $(VENV)/built
	JKTOOLS_FUZZ=1 pytest tests/syntax/test_differential.py tests/geometry/test_occluders.py tests/facts/test_sight_bounds.py \
	  tests/facts/test_cog_bounds.py tests/runtime
	python -m benchmarks.sight_disagreement --queries 1000000
	python -m benchmarks.sees_disagreement --queries 1000000
	python -m benchmarks.drop_disagreement --queries 1000000
	python -m benchmarks.runtime_disagreement
	python -m benchmarks.visibility_missed --level azulcity --each 2000
	python -m benchmarks.visibility_missed --each 20
	python -m benchmarks.ledge_disagreement --places 20000
	python -m benchmarks.ledge_tiers
	python -m benchmarks.rebuild

fresh:
	tests/fresh.sh

# Everything in the repository that is made from something else in it.
generate: $(VENV)/built
	python -m tools.generate

# The same, after counting every rule's findings over the corpus of real mods.
counts: $(VENV)/built
	python -m tools.generate --count

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

$(VENV)/built: $(VENV)/tools $(NATIVE) $(FOLDERS)
	pip install -q --no-build-isolation --editable . -C build-dir=build/native -C cmake.define.JKTOOLS_NATIVE_TESTS=ON
	@touch $@
