#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the sphere sets of a case: cases/prepare.sh CASE_DIR
#
# Each line of CASE_DIR/spheres.txt is the arguments of one spherize call, "MESH [option]... -o FILE",
# with paths relative to the case folder; "#" starts a comment line. A set newer than its mesh,
# spheres.txt and the program is kept. SPHERIZE names another program than build/release/bin/spherize.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
spherize=$(realpath -m "${SPHERIZE:-$root/build/release/bin/spherize}")

fail() {
    echo "prepare.sh: $*" >&2
    exit 2
}

[[ $# -eq 1 ]] || fail "usage: cases/prepare.sh CASE_DIR"
[[ -x $spherize ]] || fail "no program $spherize; run ./bootstrap.sh build or set SPHERIZE"
[[ -f $1/spheres.txt ]] || fail "no file $1/spheres.txt; it lists the spherize calls of a case"
cd "$1"

mapfile -t lines <spheres.txt
for line in "${lines[@]}"; do
    read -r -a arguments <<<"$line"
    [[ ${#arguments[@]} -eq 0 || ${arguments[0]} == '#'* ]] && continue
    mesh=${arguments[0]}
    output=
    for ((k = 1; k + 1 < ${#arguments[@]}; ++k)); do
        [[ ${arguments[k]} == -o ]] && output=${arguments[k + 1]}
    done
    [[ -n $output ]] || fail "$1/spheres.txt: '${arguments[*]}' names no output; add -o FILE"
    [[ -f $mesh ]] || fail "$1/spheres.txt: no mesh $mesh; paths are relative to $1"
    if [[ $output -nt $mesh && $output -nt spheres.txt && $output -nt $spherize ]]; then
        echo "$1/$output is up to date" >&2
    else
        "$spherize" "${arguments[@]}"
    fi
done
