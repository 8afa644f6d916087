#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One run of a sweep: run_case.sh ICESOLVE CASE RUN_FOLDER [OPTION]...
# Goes on from the checkpoint of an interrupted run; one of another case or program is dropped, and
# so is a run with other values: the sweep decides what is computed again.
set -euo pipefail
icesolve=$1 case=$2 run=$3
shift 3

if [[ -f $run/checkpoint.h5 ]]; then
    status=0
    "$icesolve" "$case" --out "$run" --restart "$run/checkpoint.h5" "$@" || status=$?
    [[ $status -eq 2 ]] || exit "$status" # 2: the checkpoint does not fit
    echo "run_case.sh: begins again without the checkpoint" >&2
fi
exec "$icesolve" "$case" --out "$run" --overwrite "$@"
