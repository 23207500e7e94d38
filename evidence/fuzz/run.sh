#!/bin/sh
# Fuzzes each reader for SECONDS (60), and runs random documents as long, or only those named: evidence/fuzz/run.sh table scene documents
# Needs a C++ compiler for libFuzzer; stable Rust will do, as the coverage counters are a pass of LLVM.
# A case may take TIMEOUT seconds and MEMORY MiB; the counters and assertions make it some four times slower than a release, and the formulas
# of a document may take a few seconds together. What is found is in target/fuzz/NAME; cases that fail are in target/fuzz/failed.
set -eu
cd "$(dirname "$0")/../.."
seconds=${SECONDS_EACH:-60} timeout=${TIMEOUT:-10} memory=${MEMORY:-512}
host=$(rustc -vV | sed -n 's/^host: //p')
found=$PWD/target/fuzz
export RUSTFLAGS="--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
-Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
-Cllvm-args=-sanitizer-coverage-trace-compares"
documents() { # in the build that a user has, as times are limited; overflow is looked for as well
    echo "running random documents for $seconds seconds"
    env -u RUSTFLAGS CARGO_PROFILE_RELEASE_OVERFLOW_CHECKS=true SECONDS_EACH="$seconds" cargo test --release --locked -p shadowstep-cli --features mpfr --test documents -- --ignored --nocapture
}
if [ "$*" = documents ]; then
    documents
    exit
fi
cargo build --release --locked --manifest-path evidence/fuzz/Cargo.toml --target "$host" --target-dir target/fuzz/build
mkdir -p "$found/failed"
for name in ${*:-table expression scene sweep checkpoint code documents}; do
    if [ "$name" = documents ]; then
        documents
        continue
    fi
    mkdir -p "$found/$name"
    echo "fuzzing the reader of ${name}s for $seconds seconds"
    "target/fuzz/build/$host/release/$name" "$found/$name" "evidence/fuzz/corpus/$name" \
        -max_total_time="$seconds" -timeout="$timeout" -rss_limit_mb="$memory" -max_len=4096 \
        -artifact_prefix="$found/failed/$name-" -print_final_stats=1
done
