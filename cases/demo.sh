#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From mesh to resistance curve: cases/demo.sh [FOLDER [SEED]]
#
# Runs cases/paper-3d-defaults at three speeds, three seeds each from SEED (1) on, and beside them
# cases/paper-3d once, the same ship and pieces under the paper's own rules, in FOLDER-paper-rules.
# Prints the resistances beside the formula, and where curve and report are. FOLDER is results/demo;
# runs in it are replaced. The programs are those in BIN where set, else in build/release/bin.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
    echo "demo.sh: $*" >&2
    exit 2
}

[[ $# -le 2 ]] || fail "usage: cases/demo.sh [FOLDER [SEED]]"
out=$(realpath -m "${1:-results/demo}")
bin=$(realpath -m "${BIN:-build/release/bin}")
for program in spherize icesolve icepost; do
    [[ -x $bin/$program ]] || fail "no program $bin/$program; run ./bootstrap.sh build or set BIN"
done
export SPHERIZE=$bin/spherize bin seed=${2:-1}

# Runs of the table, one each line, the longest first: folder; case; speed [m/s]; the times [s] in
# which the ship goes 24 m (the paper's field: 21 m), to the end, and 12 m (10 m), from where pieces
# lie along the whole hull; further options. Pieces moved by up to 3 mm take other ways: that makes
# the seeds.
readonly runs="\
'$out/speed-0.5' paper-3d-defaults 0.5 48 24 --seeds 3 --set simulation.jitter=0.003
'$out/speed-0.75' paper-3d-defaults 0.75 32 16 --seeds 3 --set simulation.jitter=0.003
'$out/speed-1' paper-3d-defaults 1 24 12 --seeds 3 --set simulation.jitter=0.003
'$out-paper-rules' paper-3d 0.5 42 20"

# one thread: the runs share the cores
run() { # a line's words
    local folder=$1 case=$2 speed=$3 duration=$4 settled=$5
    shift 5
    "$bin/icesolve" "cases/$case/case.cfg" --out "$folder" --overwrite --threads 1 --quiet \
        --set hull.speed="$speed" --set simulation.duration="$duration" \
        --set output.average_from="$settled" --set simulation.seed="$seed" "$@"
    echo "${folder##*/}: done"
}
export -f run

cases/prepare.sh cases/paper-3d-defaults
cases/prepare.sh cases/paper-3d >/dev/null
echo "three speeds, three seeds each, and the paper's rules: 10 runs on $(nproc) cores"
xargs -P "$(nproc)" -L 1 bash -c 'set -e; run "$@"' demo.sh <<<"$runs"
"$bin/icepost" --quiet sweep "$out"

echo
cd "$out"
"$bin/icepost" table speed-0.5 speed-0.75 speed-1 "../${out##*/}-paper-rules"
echo
echo "curve    $out/sweep.html"
echo "report   $out/speed-0.5/seed-$seed/report.html"
