#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the sphere sets and ice fields of a case: cases/prepare.sh CASE_DIR
#
# Each line of CASE_DIR/spheres.txt is the arguments of one spherize call, "MESH [option]... -o
# FILE", or of one icefield call, "SPECIFICATION.toml [option]... -o FILE", with paths relative to
# the case folder, which all outputs stay in; "#" starts a comment line. An output newer than its
# input, spheres.txt and the program is kept. The programs are SPHERIZE and ICEFIELD where set, else
# those in build/release/bin, else the installed ones.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
find_program() { # NAME, what its variable says
    local built=$root/build/release/bin/$1
    [[ -n $2 || -x $built ]] || built=$(command -v "$1" || echo "$built")
    realpath -m "${2:-$built}"
}
spherize=$(find_program spherize "${SPHERIZE:-}")
icefield=$(find_program icefield "${ICEFIELD:-}")

fail() {
    echo "prepare.sh: $*" >&2
    exit 2
}

[[ $# -eq 1 ]] || fail "usage: cases/prepare.sh CASE_DIR"
[[ -f $1/spheres.txt ]] ||
    fail "no file $1/spheres.txt; it lists the calls that make the sets of a case"
cd "$1"

mapfile -t lines <spheres.txt
for line in "${lines[@]}"; do
    read -r -a arguments <<<"$line"
    [[ ${#arguments[@]} -eq 0 || ${arguments[0]} == '#'* ]] && continue
    input=${arguments[0]} program=$spherize name=SPHERIZE kind=mesh
    [[ $input == *.toml ]] && program=$icefield name=ICEFIELD kind=specification
    [[ -x $program ]] || fail "no program $program; run ./bootstrap.sh build or set $name"
    output=
    for ((k = 1; k + 1 < ${#arguments[@]}; ++k)); do
        [[ ${arguments[k]} == -o ]] && output=${arguments[k + 1]}
    done
    # a case from a stranger shall write into its own folder only
    for argument in "${arguments[@]:1}"; do
        [[ $argument != */* ]] || fail "$1/spheres.txt: '$argument' leads out of the case folder"
    done
    [[ -n $output ]] || fail "$1/spheres.txt: '${arguments[*]}' names no output; add -o FILE"
    [[ -f $input ]] || fail "$1/spheres.txt: no $kind $input; paths are relative to $1"
    if [[ $output -nt $input && $output -nt spheres.txt && $output -nt $program ]]; then
        echo "$1/$output is up to date" >&2
    else
        "$program" "${arguments[@]}"
    fi
done
