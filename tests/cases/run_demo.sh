#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the demo in a copy, so that the source tree stays clean: run_demo.sh SOURCE_DIR COPY BIN
set -euo pipefail
rm -rf "$2"
mkdir -p "$2/cases"
cp -r "$1/meshes" "$2/"
cp -r "$1/cases/prepare.sh" "$1/cases/demo.sh" "$1/cases/paper-3d" \
    "$1/cases/paper-3d-defaults" "$2/cases/"
BIN=$3 "$2/cases/demo.sh"
