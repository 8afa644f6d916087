# SPDX-License-Identifier: GPL-3.0-or-later
"""summary.json of the floe that a barge meets on its corner, by hand (check_hit.py)."""
import h5py
import numpy as np

from check_hit import (AVERAGE_FROM, DENSITY, DURATION, FLOE, LOW, PLACE_Y, RUN, SPEED, STEP,
                       THICKNESS, Impact)
from solids import moments, prism
from tables import read_csv


def make(work):
    """The run is check_hit's."""


def check(work, values):
    forces = read_csv(work / RUN / "forces.csv")
    check_summary(work, values, Impact(), int(np.abs(forces["contact_fx_N"]).argmax()))


def check_summary(work, values, hit, row):
    s = work.summary(RUN)
    check_run_keys(work, values, s)
    steps = round(DURATION / STEP)
    first = round(AVERAGE_FROM / STEP) - 1  # the row of t = average_from is the first that counts
    count = steps - first
    series = np.zeros(count)
    series[row - first] = hit.impulse / STEP
    r = s["resistance"]
    # the time at 95 % is not defined for one peak: elsewhere.toml has the tests of the interval
    for name, want in (("mean_N", series.mean()), ("contact_mean_N", series.mean()),
                       ("friction_mean_N", 0.0), ("std_N", series.std(ddof=1)),
                       ("max_N", hit.impulse / STEP)):
        values.close("summary.json", "resistance." + name, r[name], want, 1e-6, margin=1e-9)
    # least squares through the rows; the rise is from the first row's begin to the last one's end
    t = np.arange(count)
    rise = np.polyfit(t, series, 1)[0] * count
    values.close("summary.json", "resistance.trend_N", r["trend_N"], rise, 1e-6)
    bow = s["regions"]["side1"]
    values.equal("summary.json", "regions.<region>.hits", bow["hits"], 1)
    values.close("summary.json", "regions.<region>.max_impulse_Ns", bow["max_impulse_Ns"],
                 hit.impulse, 1e-6)
    for name in ("mean_N", "contact_mean_N"):
        values.close("summary.json", f"regions.<region>.{name}", bow[name],
                     [-series.mean(), 0, 0], 1e-6)
    values.close("summary.json", "regions.<region>.friction_mean_N", bow["friction_mean_N"],
                 [0, 0, 0], margin=1e-9)
    check_particulars(values, s)
    check_energy(values, s, hit)
    check_peaks(values, s, hit, count)
    check_contacts(work, values, s)


def check_run_keys(work, values, s):
    for name, want in (("schema", "icesolve-summary/1"), ("status", "completed"),
                       ("title", "one floe"), ("case_file", "hit.cfg"), ("dimension", 3),
                       ("command_line", work.hit_command), ("threads", 2),
                       ("steps", round(DURATION / STEP)), ("warnings[].text", True)):
        got = s.get(name) if name in s else all(w["text"] for w in s["warnings"])
        values.equal("summary.json", name, got, want)
    values.close("summary.json", "simulated_s", s["simulated_s"], DURATION, 1e-9)
    values.equal("summary.json", "average_from_s", s["average_from_s"], AVERAGE_FROM)
    values.close("summary.json", "realtime_factor", s["realtime_factor"], DURATION / s["wall_s"],
                 1e-9)
    stages = sum(s["stage_seconds"].values())
    values.within("summary.json", "stage_seconds.<stage>", stages, 0.0, s["wall_s"])
    values.within("summary.json", "wall_s", s["wall_s"], stages, 600.0)
    values.equal("summary.json", "simd", s["simd"] in ("scalar", "sse4", "avx2", "avx512"), True)
    again = work.run("icesolve", "hit.cfg", "--json", "--out", "hit-again", "--no-report",
                     "--simd", "scalar", "--threads", 1)
    values.equal("summary.json", "state_hash", s["state_hash"] in again, True)
    work.check_origin(values, "summary.json", s)


def check_particulars(values, s):
    ship, ice, travel = s["ship"], s["ice"], s["travel"]
    draught = -LOW
    for name, want in (("length_m", 8.0), ("breadth_m", 5.0), ("draught_m", draught),
                       ("displacement_kg", 1013.0 * 8 * 5 * draught), ("speed_mean", SPEED)):
        values.close("summary.json", "ship." + name, ship[name], want, 1e-6)
    values.equal("summary.json", "ship.stem_angle_deg", ship["stem_angle_deg"], None)  # no stem
    area = moments(prism(FLOE, 0, THICKNESS))[0] / THICKNESS
    size = 2 * np.sqrt(area / np.pi)
    for name, want in (("thickness_m", THICKNESS), ("floes", 2), ("floe_size_min_m", size),
                       ("floe_size_mean_m", size), ("floe_size_max_m", size),
                       ("density_kg_per_m3", DENSITY), ("friction_ship_ice", 0.0),
                       ("friction_ice_ice", 0.27), ("water_density_kg_per_m3", 1013.0),
                       ("gravity_m_per_s2", 0.0)):
        values.close("summary.json", "ice." + name, ice[name], want, 1e-9)
    values.equal("summary.json", "ice.hold", ice["hold"], ["never"])
    values.equal("summary.json", "ice.crushing_pressure_Pa", ice["crushing_pressure_Pa"], None)
    values.close("summary.json", "travel.distance_m", travel["distance_m"], SPEED * DURATION, 1e-9)
    values.close("summary.json", "travel.lengths", travel["lengths"], SPEED * DURATION / 8.0, 1e-9)
    values.close("summary.json", "travel.averaged_lengths", travel["averaged_lengths"],
                 SPEED * (DURATION - AVERAGE_FROM) / 8.0, 0.02)
    for name, want in (("total", 2), ("moved", 2), ("behind", 0)):
        values.equal("summary.json", "floes." + name, s["floes"][name], want)


def check_energy(values, s, hit):
    """The ship gives J U; what the floe does not have is lost to restitution."""
    energy = s["energy"]
    for name, want in (("ship_work_J", hit.impulse * SPEED), ("kinetic_change_J", hit.energy),
                       ("kinetic_J", hit.drifting + hit.energy),
                       ("kinetic_max_J", hit.drifting + hit.energy),
                       ("restitution_J", hit.impulse * SPEED - hit.energy)):
        values.close("summary.json", "energy." + name, energy[name], want, 1e-6)
    for name in ("potential_J", "friction_J", "crushing_J", "drag_J", "buoyancy_moment_J",
                 "residual_J", "separation_J", "residual_share"):
        values.close("summary.json", "energy." + name, energy[name], 0.0, margin=1e-6)
    for key, share in s["imbalance"].items():
        values.within("summary.json", "imbalance." + key, share, 0.0, 1e-12)


def check_peaks(values, s, hit, count):
    """One window of 0.1 s has the impulse; the last one, not whole, does not count."""
    windows = count // round(0.1 / STEP)
    force = hit.impulse / 0.1
    rule = s["panel_rule"]
    values.close("summary.json", "panel_rule.window_s", rule["window_s"], 0.1, 1e-9)
    # as large as the ice is thick, or two spacings of the hull's spheres where these are wider
    values.close("summary.json", "panel_rule.size_m", rule["size_m"], 2 * 0.3, 1e-9)
    values.equal("summary.json", "panel_rule.peak", "up-crossings" in rule["peak"], True)
    peaks = s["regions"]["side1"]["force_peaks"]
    values.equal("summary.json", "regions.<region>.force_peaks.count", peaks["count"], 1)
    # the mean and the percentile are those of the windows
    for name, want in (("mean_N", force / windows), ("p99_N", force), ("max_N", force)):
        values.close("summary.json", f"regions.<region>.force_peaks.{name}", peaks[name], want,
                     1e-6)
    top = peaks["exceeded"][0]
    key = "regions.<region>.force_peaks.exceeded[]."
    values.close("summary.json", key + "level_N", top["level_N"], force, 1e-6)
    values.close("summary.json", key + "per_hour", top["per_hour"], 3600 / (0.1 * windows), 1e-9)
    touched = [p for p in s["panels"] if p["region"] == "side1"]
    values.equal("summary.json", "panels[].region", len(touched), len(s["panels"]))
    values.equal("summary.json", "panel_rule.touched", rule["touched"], len(touched))
    area = sum(p["pressure_max_Pa"] * p["area_m2"] for p in touched)
    values.close("summary.json", "panels[].pressure_max_Pa", area, force, 1e-6)
    mean = sum(p["pressure_mean_Pa"] * p["area_m2"] for p in touched)
    values.close("summary.json", "panels[].pressure_mean_Pa", mean, force / windows, 1e-6)
    for part, value in (("max", force), ("mean", force / windows)):
        line = sum(p[f"line_load_{part}_N_per_m"] * p["length_m"] for p in touched)
        values.close("summary.json", f"panels[].line_load_{part}_N_per_m", line, value, 1e-6)
    # 99 % of so few windows is the largest of them
    for name in ("line_load_{}_N_per_m", "pressure_{}_Pa"):
        top = [p[name.format("p99")] for p in touched]
        values.within("summary.json", f"panels[].{name.format('p99')}", top, 0.0,
                      max(p[name.format("max")] for p in touched))
    for p in touched:
        values.close("summary.json", "panels[].normal", p["normal"], [1, 0, 0], 1e-6)
        values.close("summary.json", "panels[].center_m", p["center_m"][0], 0.0, margin=0.16)
        # the corner's place on the bow
        values.close("summary.json", "panels[].center_m", p["center_m"][1], PLACE_Y + hit.arm[1],
                     margin=p["length_m"])
        values.within("summary.json", "panels[].area_m2", p["area_m2"], 0.0, p["length_m"] * 2.0)
        values.within("summary.json", "panels[].length_m", p["length_m"], 0.1,
                      1.5 * rule["size_m"])
    line = s["regions"]["side1"]["line_load_peaks"]
    hardest = max(p["line_load_max_N_per_m"] for p in touched)
    values.equal("summary.json", "regions.<region>.line_load_peaks.count", line["count"], 1)
    for name, want in (("mean", hardest / windows), ("p99", hardest), ("max", hardest)):
        values.close("summary.json", f"regions.<region>.line_load_peaks.{name}_N_per_m",
                     line[f"{name}_N_per_m"], want, 1e-6)
    top, key = line["exceeded"][0], "regions.<region>.line_load_peaks.exceeded[]."
    values.close("summary.json", key + "level_N_per_m", top["level_N_per_m"], hardest, 1e-6)
    values.close("summary.json", key + "per_hour", top["per_hour"], 3600 / (0.1 * windows), 1e-9)


def check_contacts(work, values, s):
    forces = read_csv(work / RUN / "forces.csv")
    contacts = s["contacts"]
    for name, want in (("mean", forces["contacts"].mean()), ("max", forces["contacts"].max())):
        values.close("summary.json", "contacts." + name, contacts[name], want, 1e-9)
    values.close("summary.json", "contacts.max_overlap_m", contacts["max_overlap_m"],
                 forces["max_overlap_m"].max(), 1e-6, margin=1e-9)
    values.equal("summary.json", "contacts.unconverged_steps", contacts["unconverged_steps"], 0)
    values.within("summary.json", "contacts.residual_share", contacts["residual_share"], 0.0, 1e-6)
    for kind in ("hull", "ice"):
        name = "barge.h5" if kind == "hull" else "corner.h5"
        with h5py.File(work / name) as file:
            many = int(file.attrs["spheres"]) * (1 if kind == "hull" else 2)
        values.equal("summary.json", "spheres." + kind, s["spheres"][kind], many)
