# The two commands: `make run` shows what this is for, `make test` checks everything and fetches what is missing.

# What is built once needs no incremental files. Without `make`, cargo has its own default.
export CARGO_INCREMENTAL ?= 0

.PHONY: run test additions wasm help-files wheel python-environment test-python book bench-python test-cluster test-emit deps format lint check docs bench stability rivals package fuzz valgrind

# The paper's main job: the drift of the modified energy on Kepler's problem at 120 digits.
run:
	cargo run --profile quick --locked -p shadowstep-cli -- drift --problem kepler \
	    --scheme stormer-verlet,yoshida4,blanes-moan-s6,blanes-moan-srkn6b \
	    --step 1/10,1/20,1/40 --until 100 --digits 120 --estimator central --order auto

test: deps format lint check wasm test-python docs

format:
	cargo fmt --all --check

lint:
	cargo clippy --workspace --features mpfr --all-targets --locked -- -D warnings

# All tests and doc tests. One test compiles the library without its features, as a user does; what else is without GMP and MPFR is compiled, without
# warnings, and tested as the Python package. One test reads the licences of all dependencies, also of those that other systems need.
check:
	cargo fetch --locked
	cargo test --workspace --features mpfr --locked

# Something of each kind that CONTRIBUTING.md says how to add compiles, in a copy of the sources: a check of the whole workspace more.
additions: deps
	cargo test -p shadowstep-tests --locked additions -- --ignored

# The library and scenes compile for WebAssembly; skipped without that target of rustc.
wasm:
	@if [ -d "$$(rustc --print sysroot)/lib/rustlib/wasm32-unknown-unknown" ]; then \
	    cargo check --target wasm32-unknown-unknown -p shadowstep -p shadowstep-scenes --locked; \
	else echo "WebAssembly is skipped: rustup target add wasm32-unknown-unknown"; fi

RUSTDOC = RUSTDOCFLAGS="-D warnings --html-in-header $(CURDIR)/runtime/formulas.html" cargo doc --no-deps --locked
docs:
	$(RUSTDOC) --workspace --features mpfr

# A wheel of the Python package in target/wheels, for CPython 3.10 and later, with the tools in a virtual environment of its own. It contains no LGPL
# code. `make wheel MPFR=1` adds MPFR, for more than 307 digits, and its licence texts.
PYTHON = python3
WHEEL = $(abspath $(or $(CARGO_TARGET_DIR),target))/python
MPFR_SOURCE = $(dir $(shell cargo metadata --locked --format-version 1 | grep -o '"manifest_path":"[^"]*gmp-mpfr-sys-[^"]*Cargo.toml' | cut -d'"' -f4))
# Equal functions once, and similar ones side by side, where they compress well: 1.2 MB less to download. For rustc's own linker, which it has for this machine.
OPTIONS_OF_RUST_LLD = -- -C link-arg=-Wl,--icf=all,--bp-compression-sort=both
SMALLER = $(if $(findstring host: x86_64-unknown-linux-gnu,$(shell rustc -vV)),$(OPTIONS_OF_RUST_LLD))
wheel: $(WHEEL)/tools/bin/maturin help-files
	rm -f python/LICENSE-LGPL-3.0 python/LICENSE-GPL-3.0
	$(if $(MPFR),cp $(MPFR_SOURCE)gmp-*-c/COPYING.LESSERv3 python/LICENSE-LGPL-3.0)
	$(if $(MPFR),cp $(MPFR_SOURCE)gmp-*-c/COPYINGv3 python/LICENSE-GPL-3.0)
	$(WHEEL)/tools/bin/maturin build --release --locked --compression-level 9 --manifest-path python/Cargo.toml --out target/wheels $(if $(MPFR),--features mpfr) $(SMALLER)
	rm -f python/LICENSE-LGPL-3.0 python/LICENSE-GPL-3.0

# Pages of man and completions of shells, which the wheel installs below `share`.
HELP = python/shadowstep._shadowstep.data/data/share
help-files:
	cargo build --profile quick --locked -p shadowstep-cli
	rm -rf python/shadowstep._shadowstep.data
	mkdir -p $(HELP)/bash-completion/completions $(HELP)/zsh/site-functions $(HELP)/fish/vendor_completions.d
	set -e; program=$(or $(CARGO_TARGET_DIR),target)/quick/shadowstep; \
	    $$program man --out $(HELP)/man/man1; \
	    $$program completions bash > $(HELP)/bash-completion/completions/shadowstep; \
	    $$program completions zsh > $(HELP)/zsh/site-functions/_shadowstep; \
	    $$program completions fish > $(HELP)/fish/vendor_completions.d/shadowstep.fish

$(WHEEL)/tools/bin/maturin:
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || ./.ci/install-python
	$(PYTHON) -m venv $(WHEEL)/tools
	$(WHEEL)/tools/bin/pip install --quiet --no-compile 'maturin>=1.9,<2'

# For what the book and the package for tests have in common: cargo compiles again for other flags.
DENY_WARNINGS = RUSTFLAGS="$$RUSTFLAGS -D warnings"

# A new virtual environment with a wheel that is built in little time, and with the packages that tests, notebooks and the book need. They are downloaded while the wheel is built.
python-environment: $(WHEEL)/tools/bin/maturin
	rm -rf $(WHEEL)/wheels $(WHEEL)/test
	$(PYTHON) -m venv $(WHEEL)/test
	$(PYTHON) -c 'import sys, tomllib; all = tomllib.load(open("python/pyproject.toml", "rb")); names = sys.argv[1].split(","); \
	    print(*all["project"]["dependencies"], *sum((all["dependency-groups"][name] for name in names), []), sep="\n")' $(or $(DEPENDENCY_GROUPS),test) > $(WHEEL)/needed.txt
	$(WHEEL)/test/bin/pip install --quiet --no-compile --requirement $(WHEEL)/needed.txt & \
	$(DENY_WARNINGS) $(WHEEL)/tools/bin/maturin build --profile quick --locked --compatibility linux --manifest-path python/Cargo.toml --out $(WHEEL)/wheels; \
	built=$$?; wait $$! && exit $$built
	$(WHEEL)/test/bin/pip install --quiet --no-compile $(WHEEL)/wheels/*.whl

# The Python package in that environment, on all cores: its tests, doctests, types and notebooks. PyTorch, which is large, is tested where it is installed.
test-python: python-environment
	cd python/tests && TQDM_DISABLE=1 $(WHEEL)/test/bin/python -m pytest --numprocesses auto --maxprocesses 8 --dist worksteal --quiet --doctest-modules --doctest-ignore-import-errors --pyargs shadowstep .

# The documentation as pages in target/book, which need no network: texts, notebooks with their outputs, the Python package, and beside them rustdoc's pages of
# the crates in docs/book/rust-api.md, one after the other, as rustdoc makes links to crates that have pages. Outputs of notebooks are kept until one of
# them or the package changes.
book: DEPENDENCY_GROUPS = book
book: python-environment
	rm -rf $(or $(CARGO_TARGET_DIR),target)/doc target/book
	set -e; for crate in -limbs -schemes -analysis -macros '' -scenes -studies; do \
	    $(DENY_WARNINGS) $(RUSTDOC) --profile quick --all-features -p shadowstep$$crate; \
	done
	! grep -rlE --include='*.html' '\[<code>[^<]*</code>\]|href="[a-z_]*::' $(or $(CARGO_TARGET_DIR),target)/doc
	mkdir -p target/book
	cp -r $(or $(CARGO_TARGET_DIR),target)/doc target/book/rust
	TQDM_DISABLE=1 $(WHEEL)/test/bin/python -m sphinx --fail-on-warning --keep-going --quiet -b html -c docs/book -d $(WHEEL)/book \
	    -D nb_execution_cache_path=$(WHEEL)/outputs-$$(cat $(WHEEL)/test/lib/python*/site-packages/shadowstep/*.py \
	        $(WHEEL)/test/lib/python*/site-packages/shadowstep/*.so | sha256sum | cut -c1-16) . target/book
	echo '<meta http-equiv="refresh" content="0; url=README.html"><a href="README.html">Shadowstep</a>' > target/book/index.html
	@echo "The book is target/book/index.html."

# What a run costs from Python beside a loop in Rust, on a machine without other load: the table of docs/python.md.
bench-python: wheel
	cargo build --release --locked -p shadowstep --example steps-of-kepler
	$(WHEEL)/tools/bin/pip install --quiet --force-reinstall numba target/wheels/shadowstep-*.whl
	$(WHEEL)/tools/bin/python python/benches/overhead.py $(abspath $(or $(CARGO_TARGET_DIR),target))/release/examples/steps-of-kepler

# Sweeps on Slurm (of Debian's packages, with a private configuration), with GNU parallel and with Dask, whose tasks and nodes are killed:
# the results are those of one machine. What is not installed is skipped.
test-cluster: deps
	cargo build --workspace --features mpfr --locked --bin shadowstep
	@command -v python3 >/dev/null || { echo "Skipped: python3 is not installed."; exit 0; }; \
	    PYTHONDONTWRITEBYTECODE=1 exec python3 tests/cluster/test.py

# What `shadowstep emit` writes, run in its own ecosystem. What is not installed is skipped; `make test-emit REQUIRED="fortran jax"` insists on these.
REQUIRED =
test-emit:
	cargo build --workspace --features mpfr --locked --bin shadowstep
	@command -v python3 >/dev/null || { echo "Skipped: python3 is not installed."; exit 0; }; \
	    REQUIRED="$(REQUIRED)" PYTHONDONTWRITEBYTECODE=1 exec python3 tests/emit/test.py

# What steps, potentials and the monitor cost: writes docs/benchmarks.md, on a machine without other load.
bench: deps
	cargo bench -p shadowstep --features mpfr --locked --no-run
	{ printf '<!-- Written by `make bench`; do not edit. -->\n\n# Benchmarks\n\n'; \
	  printf 'Medians of 21 rounds in which all contestants take turns; ratios are medians of those to the first one in the same round.\n'; \
	  printf 'Measured on %s: %s, %s cores, %s. The load of the machine was %s when it began.\n' "$$(date +%F)" \
	    "$$(sed -n 's/^model name.*: //p' /proc/cpuinfo 2>/dev/null | head -1)" "$$(getconf _NPROCESSORS_ONLN)" \
	    "$$(rustc --version)" "$$(cut -d' ' -f1 /proc/loadavg 2>/dev/null)"; \
	  for name in steps double limbs estimators potentials monitor ensembles double_double summation kepler_drift planets tangent; do \
	    printf '\n## %s\n\n`cargo bench -p shadowstep --bench %s`\n' "$$name" "$$name"; \
	    cargo bench -p shadowstep --features mpfr --locked --bench "$$name"; \
	  done; \
	  printf '\n## In a crate of one'"'"'s own\n\n`cargo run --release` in `evidence/rivals/user`\n'; \
	  cargo run --release --locked --quiet --manifest-path evidence/rivals/user/Cargo.toml; } > docs/benchmarks.md.new
	mv docs/benchmarks.md.new docs/benchmarks.md
	cat docs/benchmarks.md

# Hard cases for all shipped schemes: writes docs/stability.md, within 15 minutes on two cores.
stability: deps
	cargo run --release --features mpfr --locked -p shadowstep-cli -- stability --out target/stability
	cp target/stability/stability.md docs/stability.md

# Speed against error of Shadowstep and of what one would use instead: writes docs/speed-against-error.md.
rivals: deps
	evidence/rivals/run.sh

# Fuzzes the readers of tables, formulas, scenes, sweeps, checkpoints and source code, and runs random documents, SECONDS each:
# `make fuzz SECONDS=600 READERS="table scene documents"`.
SECONDS = 60
fuzz: deps
	SECONDS_EACH=$(SECONDS) evidence/fuzz/run.sh $(READERS)

# A short run in MPFR with modified energies under valgrind: an invalid access or an uninitialised value is an error. Leaks are not looked
# for: each thread has MPFR's caches of constants until the program ends.
valgrind: deps
	cargo build --features mpfr --locked -p shadowstep-cli
	valgrind --quiet --error-exitcode=9 --leak-check=no target/debug/shadowstep drift kepler \
	    --scheme yoshida4 --step 1/10 --until 1 --digits 50 --mpfr --order 8 --no-summary

# Packs every crate but the tests as for crates.io, and builds each from its package. cargo would build again with the
# packages that an earlier run has unpacked, so these are removed first.
package: deps
	rm -rf target/packed "$${CARGO_HOME:-$$HOME/.cargo}"/registry/src/-*/shadowstep*
	cargo package --workspace --exclude shadowstep-tests --exclude shadowstep-python --allow-dirty --locked --target-dir target/packed

# Where cargo's crate gmp-mpfr-sys keeps the libraries that it has built.
GMP_FOLDERS = "$${GMP_MPFR_SYS_CACHE:-$${XDG_CACHE_HOME:-$$HOME/.cache}/gmp-mpfr-sys}" \
    "$$HOME/Library/Caches/gmp-mpfr-sys" "$${CARGO_TARGET_DIR:-target}"

# GMP and MPFR are built from their sources, which needs m4 and a C compiler.
deps:
	@command -v cc >/dev/null && command -v make >/dev/null || \
	    { echo "A C compiler and make are needed to build GMP: install gcc and make." >&2; exit 1; }
	@command -v m4 >/dev/null || ./.ci/install-m4
	@find $(GMP_FOLDERS) -name libmpfr.a 2>/dev/null | grep -q . || \
	    echo "GMP and MPFR are now built from their sources, once: the first build takes a few minutes."
