#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One case on every instruction set and with 1, 2, 3, 4 and 8 threads: the hashes must be the same.

    same_bits.py ICESOLVE CASE WORK_DIR [OPTION]...

Compares what --hash-every prints, so that a difference names the first step in which it shows.
Instruction sets that the machine lacks are left out, and said to be.
"""
import pathlib
import subprocess
import sys

EVERY = "20"  # steps


def hashes(icesolve, case, out, options):
    """Lines of step and hash, or None where the machine lacks the instruction set."""
    command = [icesolve, case, "--out", out, "--overwrite", "-q", "--no-report",
               "--hash-every", EVERY, *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 2 and "--simd" in done.stderr:
        return None
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
    return done.stdout.splitlines()


def main():
    icesolve, case, work, *more = sys.argv[1:]
    work = pathlib.Path(work)
    variations = [(simd, threads) for simd in ("scalar", "sse4", "avx2", "avx512")
                  for threads in (1, 2)]
    variations += [("auto", threads) for threads in (3, 4, 8)]
    expected = None
    for simd, threads in variations:
        name = f"{simd}-{threads}"
        lines = hashes(icesolve, case, work / name,
                       ["--simd", simd, "--threads", str(threads), *more])
        if lines is None:
            print(f"{name}: not on this machine")
            continue
        if expected is None:
            expected, first = lines, name
            if len(lines) < 2:
                sys.exit("the run is too short: fewer than two hashes to compare")
        if lines != expected:
            step = next(a for a, b in zip(lines, expected) if a != b).split()[0]
            sys.exit(f"{name} differs from {first}, first seen at step {step}")
        print(f"{name}: {lines[-1]}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
