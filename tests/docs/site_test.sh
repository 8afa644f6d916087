#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# site_test.sh SOURCE WORK: docs/build_html.sh makes all pages and a search index, and refuses a
# link to a page or a heading that does not exist. Skipped (exit code 77) without Sphinx and MyST.
set -euo pipefail
source=$1 work=$2 tree=$2/tree suffix=md
rm -rf "$work"
mkdir -p "$tree"
status=0
"$source/docs/build_html.sh" "$work/html" || status=$?
[[ $status -ne 77 ]] || exit 77

fail() {
    echo "site_test.sh: $*" >&2
    exit 1
}
[[ $status -eq 0 ]] || fail "exit code $status"
for page in index README docs/your-own-ship docs/icesolve docs/case-keys docs/method \
    workflow/README; do
    [[ -f $work/html/$page.html ]] || fail "no page $page.html"
done
grep -F crush "$work/html/searchindex.js" >/dev/null ||
    fail "the search index does not know 'crush'"

# the same pages with two links that lead nowhere
cd "$source"
cp -r --parents ./*.md docs cases/*.md cases/*/README.md meshes/README.md workflow/README.md \
    packaging/README.md python/README.md validation/*/README.md examples "$tree"
# and the sources that the method's table of equations links to
grep -oE '\]\(\.\./[a-z_/]+\.[ch]pp\)' docs/method.md | sed -E 's,.*\.\./(.*)\),\1,' | sort -u |
    xargs cp --parents -t "$tree"
echo "[no page](docs/none.$suffix) and [no heading](docs/method.md#none)" >>"$tree/README.md"
if "$tree/docs/build_html.sh" "$work/broken" 2>"$work/faults"; then fail "bad links pass"; fi
for link in docs/none.$suffix 'docs/method.md#none'; do
    grep -F "not found: $link" "$work/faults" >/dev/null ||
        fail "$link is not named: $(<"$work/faults")"
done
[[ $(grep -c WARNING "$work/faults") -eq 2 ]] || fail "$(<"$work/faults")"
