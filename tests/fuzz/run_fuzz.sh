#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# run_fuzz.sh TARGET SECONDS [libFuzzer option]...: runs one target of the fuzz preset, which must
# be built, from its seeds. Findings and new inputs go to build/fuzz/TARGET.
set -euo pipefail

[[ $# -ge 2 ]] || {
    echo "usage: run_fuzz.sh case|field_spec|mesh|spheres|flow|thrust|live_edge SECONDS" \
        "[OPTION]..." >&2
    exit 2
}
target=$1 seconds=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$here/../../build/fuzz
program=$build/fuzz/fuzz_$target
[[ -x $program ]] || {
    echo "run_fuzz.sh: no program $program; cmake --build --preset fuzz makes it" >&2
    exit 2
}
work=$build/$target
mkdir -p "$work/new" "$work/findings"

options=(-max_total_time="$seconds" -artifact_prefix="$work/findings/" -max_len=40000
    -timeout=120 -rss_limit_mb=2048 -malloc_limit_mb=1024 -print_final_stats=1)
case $target in
    case | field_spec | thrust) options+=(-dict="$here/toml.dict") ;;
esac
"$program" "${options[@]}" "$@" "$work/new" "$here/corpus/$target" 2>"$work/log" ||
    { status=$?; tail -n 60 "$work/log" >&2; exit "$status"; }
grep -E '^(Done|stat::number_of_executed_units)' "$work/log" || tail -n 5 "$work/log"
