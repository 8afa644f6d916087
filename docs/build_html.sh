#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The documents as a site with search, which opens from disk: docs/build_html.sh [FOLDER]
# FOLDER is build/html. A link that leads nowhere is an error. Needs Debian's python3-sphinx and
# python3-myst-parser; the exit code is 77 without them.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=$(realpath -m "${1:-$source/build/html}")
# Debian's interpreter: another python3 in the PATH does not see Debian's packages
/usr/bin/python3 -c 'import sphinx, myst_parser' 2>/dev/null || {
    echo "build_html.sh: apt-get install --no-install-recommends" \
        "python3-sphinx python3-myst-parser" >&2
    exit 77
}
/usr/bin/python3 -B -m sphinx -q -W --keep-going -b html -d "$out.doctrees" \
    -c "$source/docs/html" "$source" "$out"
echo '<!doctype html><meta http-equiv="refresh" content="0; url=README.html">' >"$out/index.html"
echo "$out/index.html"
