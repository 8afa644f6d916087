#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# ignored_test.sh SOURCE: what the documents' commands write is no change of the repository, and
# nothing that is committed is ignored. Skipped (exit code 77) outside a clone.
set -euo pipefail
cd "$1"
git rev-parse --is-inside-work-tree >/dev/null 2>&1 || exit 77
hidden=$(git ls-files -ci --exclude-standard)
[[ -z $hidden ]] || { echo "ignored although committed: $hidden" >&2; exit 1; }
# the words behind options that write, and default names
mapfile -t written < <(
    grep -ohE -- '(-o|--out|--output|--svg|--preview|--joblog) [a-zA-Z0-9_./-]+' \
        README.md docs/{your-own-ship,spherize,icefield,iceflow,icesolve,icepost}.md |
        awk '{ print $2 }' | grep -vE '^(docs|cases|examples)/|^/|^[A-Z]+$' | sort -u
)
[[ ${#written[@]} -ge 4 ]] || {
    echo "the documents' commands write only ${written[*]}" >&2
    exit 1
}
for name in "${written[@]}" hull.spheres.h5 results/paper-3d/run.h5 \
    cases/presawn-channel/field.h5 build/x; do
    git check-ignore -q "$name" || { echo "$name is not ignored" >&2; exit 1; }
done
