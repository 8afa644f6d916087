# SPDX-License-Identifier: GPL-3.0-or-later
"""example_test.py SPHERIZE ICESOLVE ICEPOST SOURCE: examples/read_run.py and icepost read a
finished run and one that was killed (SIGKILL) on its way. Skipped (exit code 77) without h5py and
xarray."""
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

try:
    import h5netcdf  # noqa: F401
    import h5py
    import xarray  # noqa: F401
except ImportError as error:
    print(f"skipped: {error} (apt-get install python3-h5py python3-xarray python3-h5netcdf)")
    sys.exit(77)

spherize, icesolve, icepost, source = sys.argv[1:5]
OUTPUT = "[output]\nframes_every = 0.05\naverage_from = 1.2\n"


def read(path):
    return subprocess.run([sys.executable, os.path.join(source, "examples/read_run.py"), path],
                          capture_output=True, text=True, check=True).stdout


def opens(path):
    """Whether the example reads it: xarray refuses columns of which one is a flush ahead."""
    try:
        return "hardest place" in read(path)
    except subprocess.CalledProcessError as error:
        print(error.stderr)
        return False


def rows(path):
    with h5py.File(path, "r") as run:
        return run["frames/frame_time"].shape[0]


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for name in ("hull", "floe"):
        mesh = os.path.join(source, f"meshes/paper-{name}-2d.obj")
        subprocess.run([spherize, mesh, "--slice", "y=0", "-o", f"{name}.h5", "-q"], check=True)
    shutil.copy(os.path.join(source, "tests/support/short_case.cfg"), "case.cfg")
    with open("case.cfg", "a", encoding="utf-8") as file:
        file.write(OUTPUT)

    subprocess.run([icesolve, "case.cfg", "--out", "whole", "-q"], check=True)
    text = read("whole/run.h5")
    force = float(re.search(r"resistance (-?[\d.]+) N/m", text).group(1))
    with open("whole/summary.json", encoding="utf-8") as file:  # averaged from OUTPUT's 1.2 s
        mean = json.load(file)["resistance"]["mean_N"]
    assert abs(mean - force) <= 0.05 + 1e-6 * abs(mean), (text, mean)  # one decimal is printed
    # where the mean begins is in the case inside, too; without the libraries it says what to do
    shutil.copy("whole/run.h5", "older.h5")
    with h5py.File("older.h5", "a") as run:
        run.attrs.pop("average_from", None)
        del run["regions"]
    assert f"resistance {force:.1f} N/m" in read("older.h5")
    bare = subprocess.run([sys.executable, "-IS", f"{source}/examples/read_run.py", "older.h5"],
                          capture_output=True, text=True, check=False)
    assert bare.returncode == 1 and "apt-get install" in bare.stderr, bare
    parts = [float(part) for part in re.findall(r"of it on .*: (-?[\d.]+)", text)]
    assert parts and abs(sum(parts) - force) < 0.1 * (1 + len(parts)), text
    assert "short by icesolve" in text and "hardest place: [" in text, text

    # A kill while HDF5 writes may tear the file (tests/faults has such kills), and so short a run
    # writes half of the time: it is halted until what is on disk is whole, and killed there.
    run = subprocess.Popen([icesolve, "case.cfg", "--out", "killed", "-q", "--set",
                            "simulation.duration=100000"])
    history = "killed/forces.csv.part"  # a line per step: 20 frames of 10 steps each are long
    until = time.monotonic() + 120
    try:
        while True:
            time.sleep(random.uniform(0.1, 0.2))
            assert run.poll() is None, "the run ended by itself"
            assert time.monotonic() < until, "never whole on disk"
            if not os.path.exists(history) or os.path.getsize(history) < 300000:
                continue
            run.send_signal(signal.SIGSTOP)
            page = subprocess.run([icepost, "-q", "report", "killed"], check=False)
            if page.returncode == 0 and opens("killed/run.h5.part"):
                break
            run.send_signal(signal.SIGCONT)
    finally:
        run.kill()
        run.wait()
    assert not os.path.exists("killed/run.h5")
    assert rows("killed/run.h5.part") >= 20
    assert opens("killed/run.h5.part")
    subprocess.run([icepost, "-q", "report", "killed"], check=True)
    with open("killed/report.html", encoding="utf-8") as page:
        assert "before it wrote summary.json" in page.read()
    print("ok,", rows("killed/run.h5.part"), "frames of the killed run")
