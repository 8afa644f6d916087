#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Compares the table of docs/validation.md with one that validation_tests wrote, or replaces it:
#   check_table.sh check|update PAGE TABLE
# The same rows in the same order with the same text count as equal; the column "got" may differ
# in its last digits from machine to machine, and whether it is right the tests decide.
set -euo pipefail
action=$1 page=$2 table=$3
begin='<!-- validation table: begin -->' end='<!-- validation table: end -->'

inside() { awk -v b="$begin" -v e="$end" '$0 == e { on = 0 } on; $0 == b { on = 1 }' "$1"; }
without_got() { cut -d'|' -f2,3,5,6; }

case $action in
  check)
    [[ -s $table ]] || { echo "no table in $table: run validation_tests" >&2; exit 1; }
    diff <(inside "$page" | without_got) <(without_got <"$table") || {
      echo "the table of $page is not the one that the tests print: run" \
        "'ninja -C build/release validation-table-update'" >&2
      exit 1
    }
    ;;
  update)
    awk -v b="$begin" -v e="$end" -v t="$table" '
      $0 == e { while ((getline line < t) > 0) print line; on = 0 }
      !on
      $0 == b { on = 1 }' "$page" >"$page.new"
    mv "$page.new" "$page"
    ;;
  *) echo "usage: $0 check|update PAGE TABLE" >&2; exit 2 ;;
esac
