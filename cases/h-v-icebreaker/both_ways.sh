#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Computes the runs of this case: cases/h-v-icebreaker/both_ways.sh [RESULTS_DIR]
#
# At each thickness the propellers drive the ship once (case.cfg). Then it runs on a prescribed
# course at speeds around the one that it attains (prescribed.cfg). Every run covers 190 m of the
# field's 215 and averages over the last 95 m, the length of the ice along the hull. ICESOLVE names
# another program; CORES, how many run at a time.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export icesolve=${ICESOLVE:-build/release/bin/icesolve} results=${1:-results/h-v}
mkdir -p "$results"

run() { # CASE THICKNESS SPEED: the speed at the start, near the one attained where the ship is free
    local case=cases/h-v-icebreaker/$1.cfg name=h$2-u$3 duration from
    [[ $1 == case ]] && name=h$2-free
    duration=$(awk "BEGIN { printf \"%.1f\", 190 / $3 }")
    from=$(awk "BEGIN { printf \"%.1f\", 95 / $3 }")
    "$icesolve" "$case" -q --threads 1 --no-report --out "$results/$name" \
        --set "floes.file=field-$2.h5" --set "hull.speed=$3" \
        --set "simulation.duration=$duration" --set "output.average_from=$from"
    echo "$name: done"
}
export -f run

cases/prepare.sh cases/h-v-icebreaker
xargs -P "${CORES:-$(nproc)}" -L 1 bash -c 'run "$@"' run <<'END'
case 0.7 5.4
prescribed 0.7 4.0
prescribed 0.7 4.8
prescribed 0.7 5.4
prescribed 0.7 6.0
case 1.0 4.2
prescribed 1.0 2.4
prescribed 1.0 3.2
prescribed 1.0 4.0
prescribed 1.0 4.8
case 1.2 2.4
prescribed 1.2 1.6
prescribed 1.2 2.4
prescribed 1.2 3.2
END
