# SPDX-License-Identifier: GPL-3.0-or-later
"""What making the flow around a hull costs, as processor time of all threads and peak memory:

    python3 tests/bench/flow_cost.py [build/release/bin]
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# of the sphere sets only the meshes in them count
HULLS = (("paper-hull-3d", "0.2"), ("icebreaker-100m", "1.5"))


def main():
    bin_folder = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/bin").resolve()
    print("| hull | panels | residual, % | nodes | table, MB | clock s, panels and table | cpu s | "
          "peak MB |\n|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, radius in HULLS:
            spheres = Path(folder) / f"{name}.spheres.h5"
            subprocess.run([bin_folder / "spherize", ROOT / "meshes" / f"{name}.obj", "-r", radius,
                            "--mode", "surface", "-q", "-o", spheres], check=True)
            report = Path(folder) / "flow.json"
            child = subprocess.Popen([bin_folder / "iceflow", spheres, "-q", "-o",
                                      Path(folder) / "hull.flow.h5", "--json", report])
            _, status, used = os.wait4(child.pid, 0)
            if status:
                sys.exit(f"iceflow ended with status {status}")
            flow = json.loads(report.read_text(encoding="utf-8"))
            nodes = flow["nodes"][0] * flow["nodes"][1] * flow["nodes"][2]
            print(f"| {name} | {flow['panels']} | {100 * flow['residual']:.2f} | "
                  f"{' x '.join(map(str, flow['nodes']))} | {16e-6 * nodes:.2f} | "
                  f"{sum(flow['seconds'].values()):.2f} | {used.ru_utime + used.ru_stime:.2f} | "
                  f"{used.ru_maxrss / 1024:.0f} |")


if __name__ == "__main__":
    main()
