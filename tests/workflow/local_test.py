# SPDX-License-Identifier: GPL-3.0-or-later
"""local_test.py SOURCE BIN: a sweep on one machine: failed runs, resuming, the page."""
import os
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml

from sweep_case import (SWEEP, make_case, read, run_snakemake, skip_without, snakemake_words,
                        summaries, write)

skip_without("snakemake")

with tempfile.TemporaryDirectory() as folder:
    make_case(folder)

    # a run that fails (a hull in the ice at the start) is reported and does not stop the others
    sweep_at = lambda x: (SWEEP.format(speeds="[0.5, 0.8, 1.0]", seeds=2) +
                          f'[tied."hull.speed"]\n"hull.position" = [[-9.6, 0, 0], [{x}, 0, 0], '
                          "[-9.6, 0, 0]]\n")
    write(f"{folder}/sweep.toml", sweep_at(0.0))
    code, text = run_snakemake(folder, "local", "--cores", "2")
    assert code == 1, text
    assert "2 of 6 runs have no result" in text, text
    first = summaries(folder)
    assert len(first) == 4, (first, text)
    page = read(f"{folder}/out/sweep.html")
    xml.fromstring(page.replace("<!DOCTYPE html>", ""))
    assert "4 of 6 runs completed" in page
    assert "Test &lt;sweep&gt;" in page
    assert "overlap by" in page.split('id="faults"')[1]

    # mended and longer: only what is missing is computed
    write(f"{folder}/sweep.toml", sweep_at(-9.6))
    code, text = run_snakemake(folder, "local", "--cores", "2")
    assert code == 0, text
    second = summaries(folder)
    assert len(second) == 6 and all(second[run] == when for run, when in first.items()), text
    page = read(f"{folder}/out/sweep.html")
    assert "6 of 6 runs completed" in page and 'id="faults"' not in page
    code, text = run_snakemake(folder, "local", "--cores", "2")
    assert code == 0 and "Nothing to be done" in text, text

    # a changed setting is a different run
    longer = sweep_at(-9.6).replace("= 2.0", "= 200.0")
    write(f"{folder}/sweep.toml", longer)
    words = snakemake_words(folder, "local", "--cores", "1")
    sweep = subprocess.Popen(words, cwd=folder, text=True, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, start_new_session=True)
    # ... stopped by Ctrl-C; when the second has ended, Snakemake has taken note of the first
    fresh = lambda: [run for run, when in summaries(folder).items() if when > second[run]]
    while len(fresh()) < 2 and sweep.poll() is None:
        time.sleep(0.05)
    assert sweep.poll() is None, "the sweep ended before it could be stopped"
    os.killpg(sweep.pid, signal.SIGINT)
    text, _ = sweep.communicate()
    assert sweep.returncode != 0, text
    assert 2 <= len(fresh()) < 6, text
    first_done = min(fresh(), key=summaries(folder).get)
    when_done = summaries(folder)[first_done]

    # and resumed: finished runs are kept
    code, text = run_snakemake(folder, "local", "--cores", "2")
    assert code == 0, text
    assert summaries(folder)[first_done] == when_done, text
    assert len(fresh()) == 6
    assert "6 of 6 runs completed" in read(f"{folder}/out/sweep.html")

    # mistakes end with one complaint and make nothing
    write(f"{folder}/sweep.toml", SWEEP.format(speeds="[0.5]", seeds=1).replace('out"', 'new"')
          .replace("hull.speed", "hull.sped"))
    code, text = run_snakemake(folder, "local", "--cores", "1")
    assert code == 1 and "did you mean 'hull.speed'?" in text, text
    assert "Traceback" not in text, text
    assert not os.path.exists(f"{folder}/new")
    # so does a value that no run can have: no other run begins
    write(f"{folder}/sweep.toml", SWEEP.format(speeds="[0.5, -999.0]", seeds=1)
          .replace('out"', 'new"'))
    code, text = run_snakemake(folder, "local", "--cores", "1")
    assert code == 1 and "hull.speed = -999 is outside" in text and "Traceback" not in text, text
    assert not os.path.exists(f"{folder}/new")

    # a sensitivity study goes the same way to its own page, and is resumed, too
    write(f"{folder}/ranges.toml", '[[range]]\nname = "drag"\nkeys = ["drag.coefficient"]\n'
          'factors = [0.5, 2.0]\nsource = "a test"\n')
    study = SWEEP.split("[axes]")[0].replace('"out"', '"study"').replace(
        "[set]", 'seeds = 2\nranges = "ranges.toml"\n[set]')
    write(f"{folder}/study.toml", study)
    words = ["local", "--cores", "2"]
    code, text = run_snakemake(folder, *words, file="sensitivity=study.toml")
    assert code == 0 and "stated model uncertainty" in text, text
    assert len(os.listdir(f"{folder}/study/runs")) == 6
    page = read(f"{folder}/study/sensitivity.html")
    xml.fromstring(page.replace("<!DOCTYPE html>", ""))
    assert "case: 1.0" in page and "a test" in page and ">2.0<" in page
    code, text = run_snakemake(folder, *words, file="sensitivity=study.toml")
    assert code == 0 and "Nothing to be done" in text, text
    print("ok")
    sys.exit(0)
