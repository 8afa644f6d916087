#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Computes the sweeps behind docs/answers.md and puts their tables and curves there:
#   docs/make_answers.sh [--tables] [NAME]...      NAME: a file in workflow/answers without .toml
# Without names all of them. What is in results/answers already is kept; --tables computes nothing.
# Needs Snakemake. ICEPOST and CORES name another icepost and number of cores.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
icepost=${ICEPOST:-build/release/bin/icepost}
run=yes
[[ ${1:-} == --tables ]] && run=no && shift
[[ $# -gt 0 ]] || set -- speed level-ice level-ice-inputs friction potential thickness \
    stem restitution shape-channel size-channel shape-open size-open

for name in "$@"; do
    [[ -f workflow/answers/$name.toml ]] || { echo "make_answers.sh: no sweep $name" >&2; exit 2; }
    [[ $run == no ]] || snakemake -s workflow/Snakefile --profile workflow/local \
        --cores "${CORES:-$(nproc)}" --config "sweep=workflow/answers/$name.toml"
    curve=()
    grep -q "(answers/$name.svg)" docs/answers.md && curve=(--svg "docs/answers/$name.svg")
    "$icepost" sweep "results/answers/$name" -q --markdown "${curve[@]}" |
        python3 docs/insert_table.py docs/answers.md "$name"
done
