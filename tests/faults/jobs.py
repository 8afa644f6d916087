# SPDX-License-Identifier: GPL-3.0-or-later
"""The four programs at work in a folder of their own, and what they may leave there."""
import json
import os
import shutil
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MESHES = os.path.join(ROOT, "meshes")
SHORT_CASE = os.path.join(ROOT, "tests", "support", "short_case.cfg")

FIELD = """pattern = "grid"
[ice]
thickness = 0.3
[spheres]
radius = 0.05
spacing = 0.2
[floes]
size = [1.0, 0.8]
count = [3, 3]
gap = [0.1, 0.1]
"""
OUTPUT = "[output]\ntrack = [1]\naverage_from = 0.5\n"
EXPECTED = '[[expect]]\nkey = "steps"\nvalue = 200\nabs = 0.0\nwhy = "1 s of 5 ms"\n'


class Job:
    """One command; outputs are all files it leaves in the folder it runs in."""

    def __init__(self, name, words, inputs):
        self.name, self.words, self.inputs = name, words, inputs


# Inputs lie in ../in as seen from the folder of a job.
JOBS = [
    Job("spherize", ["spherize", "../in/floe.obj", "-r", "0.05", "-o", "out.h5", "--json",
                     "out.json", "--export", "csv", "--export", "vtp"], ["floe.obj"]),
    Job("icefield", ["icefield", "../in/field.toml", "-o", "field.h5", "--json", "field.json",
                     "--preview", "field.svg"], ["field.toml"]),
    Job("icesolve", ["icesolve", "../in/case.cfg", "--out", "run", "--checkpoint-every", "0.2",
                     "--no-report"], ["case.cfg", "hull.h5", "floe.h5"]),
    Job("icepost report", ["icepost", "report", "../in/run", "-o", "report.html"],
        ["run/run.h5", "run/summary.json"]),
    Job("icepost paraview", ["icepost", "paraview", "../in/run", "-o", "paraview", "--every", "5"],
        ["run/run.h5"]),
    Job("icepost plot", ["icepost", "plot", "../in/run", "-o", "plot.svg"], ["run/run.h5"]),
    Job("icepost check", ["icepost", "check", "../in/run", "../in/expected.toml", "--junit",
                          "junit.xml"], ["run/summary.json", "expected.toml"]),
]


def files_of(folder):
    """Relative names of all files in a folder, sorted."""
    found = []
    for place, _, names in os.walk(folder):
        found += [os.path.relpath(os.path.join(place, name), folder) for name in names]
    return sorted(found)


def read(path):
    with open(path, "rb") as file:
        return file.read()


class Result:
    """How a program ended. `code` is negative for a signal, None when it was stopped for time."""

    def __init__(self, code, message, out=""):
        self.code, self.message, self.out = code, message, out


class Workshop:
    """A folder with inputs, and for every job what it leaves when nothing goes wrong."""

    def __init__(self, folder, binaries):
        self.folder, self.binaries = folder, os.path.abspath(binaries)
        self.inputs = os.path.join(folder, "in")
        self.good = {}  # per job: file name -> bytes
        self.made = 0
        os.makedirs(self.inputs)
        case = read(SHORT_CASE).decode().replace("duration = 3.0", "duration = 1.0") + OUTPUT
        for name, text in (("field.toml", FIELD), ("case.cfg", case), ("expected.toml", EXPECTED)):
            with open(os.path.join(self.inputs, name), "w", encoding="utf-8") as file:
                file.write(text)
        shutil.copy(os.path.join(MESHES, "paper-floe-3d.obj"),
                    os.path.join(self.inputs, "floe.obj"))
        for name in ("hull", "floe"):
            self.must(["spherize", os.path.join(MESHES, f"paper-{name}-2d.obj"), "--slice", "y=0",
                       "-o", f"{name}.h5", "-q"], self.inputs)
        self.must(["icesolve", "case.cfg", "--out", "run", "-q", "--no-report"], self.inputs)
        for job in JOBS:
            place = self.new_folder()
            self.must(job.words, place)
            self.good[job.name] = {name: read(os.path.join(place, name))
                                   for name in files_of(place)}

    def new_folder(self):
        self.made += 1
        folder = os.path.join(self.folder, f"w{self.made}")
        os.mkdir(folder)
        return folder

    def command(self, words):
        return [os.path.join(self.binaries, words[0]), *words[1:]]

    def run(self, words, folder, **more):
        """Runs a program; `more` goes to subprocess.run."""
        options = dict(timeout=300, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                       stderr=subprocess.PIPE, check=False)
        options.update(more)
        try:
            done = subprocess.run(self.command(words), cwd=folder, **options)
        except subprocess.TimeoutExpired:
            return Result(None, "no end within the time limit")
        return Result(done.returncode, done.stderr.decode("utf-8", "replace"),
                      (done.stdout or b"").decode("utf-8", "replace"))

    def must(self, words, folder):
        done = self.run(words, folder)
        if done.code != 0:
            raise RuntimeError(f"{words} ends with {done.code} where nothing is wrong: "
                               + done.message)
        return done

    # what may be left behind

    def faults(self, job, folder, done):
        """What is wrong with the end of a job: a list of sentences."""
        wrong = []
        if done.code is None or done.code < 0 or done.code > 2:
            wrong.append(f"ends with {done.code}: {done.message.strip()[-300:]}")
        elif done.code > 0 and not has_remedy(done.message):
            wrong.append(f"exit code {done.code} without error and remedy: {done.message!r}")
        good = self.good[job.name]
        left = files_of(folder)
        if done.code == 0 and [n for n in left if not n.endswith(".part")] != sorted(good):
            wrong.append(f"exit code 0, but the files are {left}")
        for name in left:
            path = os.path.join(folder, name)
            if name.endswith(".part"):
                if job.name != "icesolve" or done.code == 0:
                    wrong.append(f"{name} is left behind")
            elif not self.is_whole(path, good.get(name, b""), done.code):
                wrong.append(f"{name} is not whole ({os.path.getsize(path)} bytes)")
        return wrong

    def is_whole(self, path, good, code):
        """Is a file with a final name what the job should have written?"""
        data, name = read(path), os.path.basename(path)
        if data == good or name == "run.log":
            return True
        if name.endswith(".csv") and code != 0:  # of a failed run: whole rows
            return good.startswith(data) and data.endswith(b"\n")
        if name.endswith(".json"):
            return is_json(data)
        if name.endswith(".html"):  # holds the time of day
            return data.endswith(b"</html>\n") and abs(len(data) - len(good)) < 100
        if name == "view.py":  # holds the folder's name
            return data.startswith(good[:20]) and data.endswith(good[-20:])
        if name == "run.h5":
            return self.can_be_read(os.path.dirname(path))
        if name == "checkpoint.h5" or name.startswith("checkpoint-rows"):
            checkpoint = os.path.join(os.path.dirname(path), "checkpoint.h5")
            # rows that no checkpoint counts are of no use, and none is made of them
            return not os.path.exists(checkpoint) or self.run(
                ["icesolve", os.path.join(self.inputs, "case.cfg"), "--restart", checkpoint,
                 "--check"], self.folder).code == 0
        return False

    def can_be_read(self, run_folder):
        """Can run.h5 or run.h5.part? One that holds no rows yet says so."""
        done = self.run(["icepost", "plot", run_folder, "-o",
                         os.path.join(self.folder, "try.svg")], self.folder)
        return done.code == 0 or "it ended before its first samples" in done.message


def is_json(data):
    try:
        json.loads(data)
    except ValueError:
        return False
    return True


def has_remedy(message):
    """An error that names what is wrong, and under it what to do."""
    lines = message.strip().splitlines()
    at = next((k for k, line in enumerate(lines) if "error: " in line), None)
    return at is not None and any(line.startswith("  ") for line in lines[at + 1:])
