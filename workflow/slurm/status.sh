#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# State of a Slurm job as Snakemake asks for it: status.sh JOB -> running, success or failed
set -uo pipefail

# scontrol knows jobs for a few minutes after their end, sacct (where accounting is on) for longer
state=$(scontrol -o show job "$1" 2>/dev/null | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p')
[[ -n $state ]] || state=$(sacct -nXP -j "$1" -o State 2>/dev/null | head -n 1 | cut -d ' ' -f 1)

case $state in
    COMPLETED) echo success ;;
    PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | RESIZING) echo running ;;
    *) echo failed ;;
esac
