# SPDX-License-Identifier: GPL-3.0-or-later
# Short ways into the CMake build; see CONTRIBUTING.md for the presets behind them.
JOBS ?= $(shell nproc)
# One more than processors: a browser or FreeCAD waits as often as it works.
TESTS_AT_ONCE ?= $(shell expr $(JOBS) + 1)
# On a machine that has everything by other means: make DEPENDENCIES=true
DEPENDENCIES ?= scripts/install-dependencies
DEMO := build/demo/bilateral_drive
PRINTED := build/demo/printed_actuator

.PHONY: all demo test bench asan tsan fuzz campaign clean

# Dependencies and the program, build/trueflank.
all:
	@$(DEPENDENCIES) build
	@cmake --preset release
	@cmake --build build -j $(JOBS)

# The paper's gearbox, from its design file to parts; and a whole actuator to print.
demo: all
	build/trueflank make examples/bilateral_drive/design.toml -o $(DEMO)
	build/trueflank make examples/printed_actuator/design.toml -o $(PRINTED)
	@echo
	@echo "The parts are in $(DEMO); start with $(DEMO)/report.html"
	@echo "An actuator to print is in $(PRINTED): bom.csv says what to buy, plate_1.3mf is ready to slice"

test:
	@$(DEPENDENCIES) build test
	@cmake --preset release -DTRUEFLANK_BUILD_TESTS=ON -DTRUEFLANK_BUILD_PYTHON=ON
	@cmake --build build -j $(JOBS)
	@cd build && ctest --output-on-failure -LE campaign -j $(TESTS_AT_ONCE)

bench:
	@$(DEPENDENCIES) build bench
	@cmake --preset release -DTRUEFLANK_BUILD_BENCH=ON
	@cmake --build build -j $(JOBS)
	@cmake --build build --target run_benches

asan:
	@$(DEPENDENCIES) build test
	@cmake --preset asan
	@cmake --build --preset asan -j $(JOBS)
	@ctest --preset asan
	@scripts/under_sanitizers build/asan/trueflank build/asan/runs --jobs $(JOBS)

# The program alone: what it does on several threads.
tsan:
	@$(DEPENDENCIES) build
	@cmake --preset tsan -DTRUEFLANK_BUILD_TESTS=OFF
	@cmake --build --preset tsan -j $(JOBS)
	@scripts/under_sanitizers build/tsan/trueflank build/tsan/runs --only threads

# Every random trial: with the day's seed, which shows whether the tests' limits hold elsewhere and decides nothing, and
# the surveys of which `make test` makes the first trials, whole.
campaign:
	@$(DEPENDENCIES) build test
	@cmake --preset release -DTRUEFLANK_BUILD_TESTS=ON
	@cmake --build build -j $(JOBS)
	@scripts/campaign build/trueflank build/campaign; days=$$?; \
	  cd build && ctest --output-on-failure -L campaign -j $(JOBS) && exit $$days

# Needs clang-14 and libclang-rt-14-dev.
MINUTES ?= 10
fuzz:
	@$(DEPENDENCIES) build
	@cmake --preset clang-asan -DTRUEFLANK_BUILD_TESTS=OFF
	@cmake --build --preset clang-asan -j $(JOBS) --target fuzzers
	@scripts/fuzz build/clang-asan $(MINUTES)

clean:
	rm -rf build
