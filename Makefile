# The few commands a user needs; CMake and Ninja do the work.
#
#   make          install what is missing, build: leaves the program at build/ifov
#   make demo     the same, render examples/demo.json, say where its pictures and report are (DEMO_FLAGS=...: with options of render)
#   make test     build and run every test
#   make python   build the Python package into build/venv (build/venv/bin/python has it)
#   make docs     make the pages of docs/ a site: build/site/index.html
#   make deb      build a Debian package of program, library, headers, manual pages and the Python package
#   make bench    build and run the benchmarks (BENCH="speed honesty": only these; BENCH_FLAGS=--long: the long versions)
#   make sanitize build and run the C++ tests under sanitizers (SANITIZE=thread: for data races)
#   make tidy     look for mistakes with clang-tidy (SINCE=main: only in what changed since then)
#   make clean    remove what was built
#
# TYPE=Debug builds with assertions; COMPILER=clang with another compiler (g++-13 and the like too). Each such build has
# a folder of its own: build-debug, build-clang.

TYPE := Release
COMPILER :=
CXX_clang = $(shell command -v clang++ || command -v clang++-14 || echo clang++)
BUILD := build$(COMPILER:%=-%)$(patsubst %,-%,$(shell echo $(TYPE:Release=) | tr A-Z a-z))
JOBS := $(shell nproc)
# Tests of ranks, browsers and killed runs wait as long as they work.
TESTS_AT_ONCE := $(shell expr $(JOBS) + 1)
# Each source alone, which shows that it includes what it needs, where nobody waits for the build.
ALONE := $(if $(filter-out build,$(BUILD)),-DIFOV_JOIN_SOURCES=OFF)
TOOLS := cmake --build $(BUILD) -j $(JOBS)

all: program

packages:
	@sh tools/install_packages.sh

configure: packages
	@test -f $(BUILD)/build.ninja || cmake -S . -B $(BUILD) -G Ninja -DCMAKE_BUILD_TYPE=$(TYPE) $(ALONE) \
	  $(COMPILER:%=-DCMAKE_CXX_COMPILER=$(or $(CXX_$(COMPILER)),%))

program: configure
	@$(TOOLS) --target ifov

demo: program
	@$(BUILD)/ifov render examples/demo.json --output $(BUILD)/demo $(DEMO_FLAGS) || test $$? -eq 5
	@echo "Picture: $(BUILD)/demo/image_quicklook.png"
	@echo "Report:  $(BUILD)/demo/image_report.html (open it in a browser)"

python: configure
	@$(TOOLS) --target libifov
	@sh tools/make_python.sh $(BUILD)
	@echo "Python with ifov: $(BUILD)/venv/bin/python"

docs: python
	@$(BUILD)/venv/bin/python -m mkdocs build --quiet --site-dir $(abspath $(BUILD))/site
	@echo "Site: $(BUILD)/site/index.html"

deb: program python
	@python3 tools/make_deb.py $(BUILD)

# Without PyPI there is no package, and its tests are skipped and say so.
test: configure
	@$(TOOLS) --target all
	@sh tools/make_python.sh $(BUILD) || true
	@python3 tools/run_tests.py $(BUILD) --jobs $(TESTS_AT_ONCE)

bench: configure
	@$(TOOLS) --target all benchmarks
	@python3 benchmarks/run.py $(BUILD) $(BENCH_FLAGS) $(BENCH)

SANITIZE := address
sanitize: packages
	@sh tools/sanitize.sh $(SANITIZE) $(TESTS)

tidy: packages
	@cmake -S . -B $(BUILD)/tidy -G Ninja -DCMAKE_BUILD_TYPE=$(TYPE) -DIFOV_JOIN_SOURCES=OFF > /dev/null
	@python3 tools/tidy.py $(BUILD)/tidy $(if $(SINCE),--since $(SINCE)) $(FILES)

clean:
	rm -rf $(BUILD)

.PHONY: all packages configure program demo python docs deb test bench sanitize tidy clean
