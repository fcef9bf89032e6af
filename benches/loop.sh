#!/usr/bin/env bash
# How long an edit takes: adds a line to one file of each crate and prints what compiling costs afterwards, up to the programs of
# unit tests and of integration tests. The line is taken back.
#
#     bash benches/loop.sh [CRATE...]
set -euo pipefail
cd "$(dirname "$0")/.."

crates=("$@")
[ ${#crates[@]} -gt 0 ] || crates=(math model format closure algebra mobility motion simulate scene report)

edited=
restore() { [ -z "$edited" ] || { mv "$edited.before" "$edited"; edited=; }; }
trap restore EXIT

build() { cargo test --quiet --no-run --locked "$@" 2>/dev/null; }

# CPU seconds (user and system) and wall seconds of a command.
TIMEFORMAT='%U %S %R'
timed() { { time build "$@"; } 2>&1 | awk '{ printf "%.0f | %.0f", $1 + $2, $3 }'; }

build
echo '| a line in | unit tests of the crate, CPU s | wall s | every test program, CPU s | wall s |'
echo '|---|---|---|---|---|'
for crate in "${crates[@]}"; do
    edited=crates/$crate/src/lib.rs
    cp -p "$edited" "$edited.before"
    printf '\n#[doc(hidden)]\npub fn edited() -> usize {\n    1\n}\n' >> "$edited"
    # Selecting the root as well keeps the features of all dependencies as they are.
    unit=$(timed --lib --package kutzbach --package "kutzbach-$crate")
    all=$(timed)
    echo "| $crate | $unit | $all |"
    restore
    touch crates/"$crate"/src/lib.rs
    build
done
