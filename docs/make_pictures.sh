#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Pictures of README and docs, from the run that ./bootstrap.sh demo makes:
#   docs/make_pictures.sh [RUN]
# Needs Chromium (apt-get install chromium). --field makes only the one of icefield.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
icefield=${ICEFIELD:-build/release/bin/icefield}
field=$(mktemp)
trap 'rm -f "$field"' EXIT
"$icefield" cases/icebreaker-100m/channel.toml --set "edges.overhang=[10,10]" -q \
    -o "$field" --preview docs/field-cusps.svg
[[ ${1:-} != --field ]] || exit 0
run=$(realpath "${1:-results/demo/speed-0.5/seed-1}")
icepost=${ICEPOST:-build/release/bin/icepost}

"$icepost" -q sweep results/demo --svg docs/demo-curve.svg
"$icepost" view "$run" --time 21 --from quarter --out docs/paper-3d-below.svg
[[ -f $run/report.html ]] || "$icepost" report "$run"
# the clock of the page runs ahead of the real one until everything is drawn
chromium --headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
    --hide-scrollbars --window-size=1100,1700 --virtual-time-budget=10000 \
    --screenshot="$PWD/docs/report.png" "file://$run/report.html#t=21&camera=keel&hull=load"

# the sweep's own curve, where Snakemake is installed: 24 runs
if command -v snakemake >/dev/null; then
    snakemake -s workflow/Snakefile --profile workflow/local --cores "$(nproc)" \
        --config sweep=workflow/paper-2d.toml
    "$icepost" sweep results/paper-2d --svg docs/sweep-paper-2d.svg
fi
