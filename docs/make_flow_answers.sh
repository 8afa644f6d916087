#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Computes the sweeps on the flow around the hull and puts their tables into docs/answers.md:
#   docs/make_flow_answers.sh [--tables] [NAME]...
# NAME is flow, flow-drag, flow-icebreaker or flow-broken. Without names all of them: some two hours
# on two cores. What is in results/answers already is kept, so the same command goes on after a
# break; --tables computes nothing. A table has the points that are there. Needs Snakemake. CORES
# names another number of cores.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
run=yes
[[ ${1:-} == --tables ]] && run=no && shift
[[ $# -gt 0 ]] || set -- flow flow-drag flow-icebreaker flow-broken

for name in "$@"; do
    [[ -f workflow/answers/$name.toml ]] || {
        echo "make_flow_answers.sh: no sweep $name" >&2
        exit 2
    }
    [[ $run == no ]] || snakemake -s workflow/Snakefile --profile workflow/local \
        --cores "${CORES:-$(nproc)}" --config "sweep=workflow/answers/$name.toml"
    python3 docs/flow_table.py "results/answers/$name" |
        python3 docs/insert_table.py docs/answers.md "$name"
done
