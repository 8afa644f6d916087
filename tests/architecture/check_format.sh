#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# All tracked C++ files are as clang-format 14 writes them: check_format.sh ROOT
# Exit code 77 (skipped) without clang-format 14 or outside a git checkout.
set -euo pipefail
cd "$1"

if ! command -v clang-format-14 >/dev/null; then
    echo "clang-format-14 is not installed"
    exit 77
fi
git rev-parse --is-inside-work-tree >/dev/null 2>&1 || { echo "no git checkout"; exit 77; }

mapfile -t files < <(git ls-files '*.hpp' '*.cpp' ':!tests/architecture/samples')
[[ ${#files[@]} -gt 0 ]] || { echo "no sources under $1"; exit 1; }
found=$(printf '%s\n' "${files[@]}" | xargs clang-format-14 --dry-run 2>&1 |
    sed -nE 's/^([^: ]+):([0-9]+):.*\[-Wclang-format-violations\]$/\1:\2/p' | sort -u)
if [[ -n $found ]]; then
    echo "$found"
    echo "not as clang-format 14 writes them: clang-format-14 -i FILE"
    exit 1
fi
echo "${#files[@]} files are formatted"
