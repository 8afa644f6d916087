#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs one case in a copy, so that the source tree stays clean:
#   run_case.sh SOURCE_DIR RUNS_DIR CASE SPHERIZE ICEFIELD ICESOLVE [OPTION]...
set -euo pipefail
source=$1 runs=$2 case=$3 spherize=$4 icefield=$5 icesolve=$6
shift 6

mkdir -p "$runs/$case-tree/cases"
cp -r "$source/meshes" "$runs/$case-tree/"
cp -r "$source/cases/prepare.sh" "$source/cases/$case" "$runs/$case-tree/cases/"
SPHERIZE=$spherize ICEFIELD=$icefield "$runs/$case-tree/cases/prepare.sh" \
    "$runs/$case-tree/cases/$case"
"$icesolve" "$runs/$case-tree/cases/$case/case.cfg" --out "$runs/$case" --overwrite "$@"
