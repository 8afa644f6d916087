#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Computes the runs of this case: cases/h-v-icebreaker/both_ways.sh [RESULTS_DIR]
#
# At each thickness the ship once driven by its propellers (case.cfg), then on rails at speeds
# around the one that it attains (captive.cfg). Every run goes 190 m of the field's 215 and averages
# over the last 95 m, the length that the ice takes along the hull. ICESOLVE names another program;
# CORES, how many run at a time.
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
captive 0.7 4.0
captive 0.7 4.8
captive 0.7 5.4
captive 0.7 6.0
case 1.0 4.2
captive 1.0 2.4
captive 1.0 3.2
captive 1.0 4.0
captive 1.0 4.8
case 1.2 2.4
captive 1.2 1.6
captive 1.2 2.4
captive 1.2 3.2
END
