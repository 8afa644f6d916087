#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# picture_test.sh SOURCE BIN: the picture of docs/icefield.md is what the command below it makes.
set -euo pipefail
source=$1
export PATH=$2:$PATH
command=$(sed -n 's/^The picture is `\(icefield .*\)`\.$/\1/p' "$source/docs/icefield.md")
[[ -n $command ]] || { echo "docs/icefield.md names no command for its picture" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/docs"
cp -r "$source/cases" "$work"
cd "$work"
eval "$command -q"
cmp docs/field-cusps.svg "$source/docs/field-cusps.svg" || {
    echo "the picture is stale: docs/make_pictures.sh --field makes it anew" >&2
    exit 1
}
