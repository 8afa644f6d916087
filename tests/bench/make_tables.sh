#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Times the solver and puts the tables into tests/bench/README.md:
#   tests/bench/make_tables.sh [NAME]...
# NAME is peers, scenes, threads, held, simd, kernels, level-ice, free-ship or side-by-side. Without
# names all of them: half an hour on a machine that does nothing else.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
bench=build/release/bin/icebench
[[ $# -gt 0 ]] || set -- peers scenes threads held simd kernels level-ice free-ship side-by-side

# icebench's line with machine and version, and its table of steps without those that follow
steps() {
    "$bench" -q "$@" |
        awk 'NR == 1 { print; print "" } /^\|/ && !done { print; seen = 1; next } seen { done = 1 }'
}

for name in "$@"; do
    grep -qx "<!-- $name: begin -->" tests/bench/README.md || {
        echo "make_tables.sh: no table $name" >&2
        exit 2
    }
    case $name in
    peers) steps --scene loose,packed --floes 100,400,1600 --threads 1 --peers --patience 10 ;;
    scenes) steps --scene paper-3d,ship-100m --threads 1,2 ;;
    threads) steps --scene loose,packed --floes 1600,10000 --threads 1,2 ;;
    held) steps --scene held --threads 1 ;;
    simd) steps --scene loose,packed --floes 1600 --threads 1 --simd all --steps 200 ;;
    kernels) "$bench" -q --kernels --scene loose,packed --floes 1600 --steps 150 --simd all ;;
    level-ice) python3 tests/bench/edge_speed.py ;;
    free-ship) python3 tests/bench/ship_cost.py ;;
    side-by-side)
        python3 tests/bench/threads.py build/release/bin --duration 34 --rounds 3 \
            --waiting GOMP_SPINCOUNT=300000 --waiting GOMP_SPINCOUNT=1000 \
            --waiting GOMP_SPINCOUNT=100
        ;;
    esac | python3 docs/insert_table.py tests/bench/README.md "$name"
done
