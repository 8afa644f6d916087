#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Overlaps of the bodies in a run's frames, found without the solver's code.

    check_poses.py RUN... [--every N | --at-end] [--max-share S] [--max-depth D] [--worst K]
                          [--json FILE]

RUN is a run folder or its run.h5. Each pair of bodies whose boxes meet is clipped exactly; the
depth is that of the deepest of either one's surface samples inside the other. Solids count whole,
as their meshes stand in run.h5: ice that contacts have crushed counts as overlap. With --at-end the
last frame alone is looked at, and volumes are without crushed ice, as the run's checkpoint.h5 of
the same time has it (README.md). Depths take notches as whole ice, so that they are upper bounds.
Pairs of unbroken ice that never move are left out. Exit code 1 when a pair is beyond a limit.
"""
import argparse
import json
import pathlib
import sys

import numpy as np

from clip_columns import overlap_volume
from crushed_notches import take_crushed, whole_share
from deepest_point import Samples, deepest
from run_poses import Run

SAMPLES_PER_THICKNESS = 5  # a floe's surface is sampled at a fifth of its thickness
LEAST_SHARE = 1e-6  # of the smaller solid's volume: less is rounding of poses, 1e-7 of a coordinate


class Frame:
    """The bodies of one frame: what moved, where the boxes are."""

    def __init__(self, run, index):
        self.run, self.index = run, index
        self.turn = np.array([run.rotation(index, b) for b in range(len(run.shape_of))])
        self.place = run.position[index]
        boxes = np.array([run.solid(b).box for b in range(len(run.shape_of))])
        middle, half = boxes.mean(axis=1), 0.5 * (boxes[:, 1] - boxes[:, 0])
        self.middle = self.place + np.einsum("bij,bj->bi", self.turn, middle)
        self.half = half
        self.reach = np.einsum("bij,bj->bi", np.abs(self.turn), half)

    def pairs(self):
        """Pairs (a < b) whose boxes in the world's axes and in their own axes meet."""
        near = (np.abs(self.middle[:, None] - self.middle[None])
                < self.reach[:, None] + self.reach[None]).all(axis=2)
        return [(a, b) for a, b in np.argwhere(np.triu(near, 1)) if self.boxes_meet(a, b)]

    def boxes_meet(self, a, b):
        for one, other in ((a, b), (b, a)):
            between = self.turn[one].T @ (self.middle[other] - self.middle[one])
            reach = np.abs(self.turn[one].T @ self.turn[other]) @ self.half[other]
            if (np.abs(between) > self.half[one] + reach).any():
                return False
        return True

    def carry(self, points, source, target):
        """Points of one body's axes in another one's."""
        world = points @ self.turn[source].T + self.place[source]
        return (world - self.place[target]) @ self.turn[target]


def measure(frame, a, b):
    """(overlap volume [m3], depth [m]) of a pair."""
    run = frame.run
    solid_a, solid_b = run.solid_to(a, b), run.solid_to(b, a)
    vertices = frame.carry(solid_b.vertices, b, a)
    triangles_a = solid_a.vertices[solid_a.triangles]
    volume = overlap_volume(vertices[solid_b.triangles], triangles_a)
    if volume < LEAST_SHARE * min(solid_a.volume, solid_b.volume):
        return max(volume, 0.0), 0.0
    volume *= uncrushed_share(frame, a, b)
    return volume, max(depth_of(frame, a, b), depth_of(frame, b, a))


def uncrushed_share(frame, a, b):
    """The share of a pair's overlap in which neither body's spheres have crushed the ice."""
    notches = [frame.run.notches.get(body) for body in (b, a)]
    if not any(notches):
        return 1.0
    solids = [frame.run.solid_to(b, a), frame.run.solid_to(a, b)]
    of_a = frame.carry(solids[1].vertices, a, b)
    box = (np.maximum(solids[0].box[0], of_a.min(axis=0)),
           np.minimum(solids[0].box[1], of_a.max(axis=0)))
    carries = (lambda points: points), (lambda points: frame.carry(points, b, a))
    triangles = [solid.vertices[solid.triangles] for solid in solids]
    return whole_share(box, list(zip(carries, triangles)), notches)


def depth_of(frame, body, other):
    """Depth of the deepest sample of the body's surface inside the other one."""
    solid, target = frame.run.solid_to(body, other), frame.run.solid_to(other, body)
    thickness = min(solid.thickness, target.thickness)
    return deepest(samples(solid, thickness / SAMPLES_PER_THICKNESS),
                   lambda points: frame.carry(points, body, other),
                   target.vertices[target.triangles], thickness)


def samples(solid, spacing):
    """The solid's samples, kept for the finest spacing asked for."""
    if solid.samples is None or solid.samples[0] > spacing:
        solid.samples = spacing, Samples(solid.vertices, solid.triangles, spacing)
    return solid.samples[1]


def check(run, every, first=0):
    """Rows {time_s, a, b, volume_m3, share, depth_m, depth_share} of all pairs that overlap."""
    rows, known, last = [], {}, None
    for index in range(first, len(run.time), every):
        frame = Frame(run, index)
        still = np.zeros(len(run.shape_of), dtype=bool)
        if last is not None:
            still = ((frame.place == last.place).all(axis=1)
                     & (frame.turn == last.turn).all(axis=(1, 2)))
        found = {}
        for pair in frame.pairs():
            a, b = pair
            if last is not None and still[a] and still[b] and pair in known:
                found[pair] = known[pair]
                continue
            found[pair] = measure(frame, a, b)
        for (a, b), (volume, depth) in found.items():
            if depth > 0.0:
                rows.append(row(run, index, a, b, volume, depth))
        known, last = found, frame
    return rows


def row(run, index, a, b, volume, depth):
    floes = [run.solid(body) for body in (a, b) if body > 0]
    smallest = min(floes, key=lambda solid: solid.volume)
    return {"time_s": float(run.time[index]), "a": int(a), "b": int(b), "volume_m3": volume,
            "share": volume / smallest.volume, "depth_m": depth,
            "depth_share": depth / smallest.thickness}


def report(run, name, rows, frames, worst):
    print(f"{name}: {frames} frames, {len(run.shape_of) - 1} floes, "
          f"{len({(r['a'], r['b']) for r in rows})} pairs overlap in some frame")
    for kind, of_kind in (("floe and floe", [r for r in rows if r["a"] > 0]),
                          ("hull and floe", [r for r in rows if r["a"] == 0])):
        deep = max((r["depth_m"] for r in of_kind), default=0.0)
        share = max((r["share"] for r in of_kind), default=0.0)
        counts = [len({r["time_s"] for r in of_kind if r["depth_share"] > limit})
                  for limit in (0.05, 0.25)]
        print(f"  {kind}: deepest {1e3 * deep:.1f} mm, largest {100 * share:.3f} % of a floe; "
              f"{counts[0]} frames with a pair deeper than 5 % of the thickness, "
              f"{counts[1]} than 25 %")
    worst_of = {}
    for r in sorted(rows, key=lambda r: -r["share"]):
        worst_of.setdefault((r["a"], r["b"]), r)
    for r in list(worst_of.values())[:worst]:
        pair = f"{run.name(r['a'])} and {run.name(r['b'])}"
        print(f"    {pair}, t = {r['time_s']:.2f} s: {r['volume_m3']:.4g} m3, "
              f"{100 * r['share']:.3f} % of a floe, {1e3 * r['depth_m']:.1f} mm deep")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", nargs="+", help="run folder or run.h5")
    parser.add_argument("--every", type=int, default=1, help="look at each n-th frame")
    parser.add_argument("--at-end", action="store_true",
                        help="the last frame, without crushed ice")
    parser.add_argument("--max-share", type=float, default=0.005,
                        help="of the smaller floe's volume (default 0.005)")
    parser.add_argument("--max-depth", type=float, default=np.inf, help="[m] (default: no limit)")
    parser.add_argument("--worst", type=int, default=5, help="pairs to print (default 5)")
    parser.add_argument("--json", help="write the rows of all overlapping pairs to this file")
    options = parser.parse_args()
    beyond, table = 0, {}
    for name in options.run:
        run = Run(name)
        first = 0
        if options.at_end:
            folder = pathlib.Path(name)
            take_crushed(run, folder if folder.is_dir() else folder.parent)
            first = len(run.time) - 1
        rows = check(run, options.every, first)
        report(run, name, rows, len(range(first, len(run.time), options.every)), options.worst)
        table[name] = rows
        beyond += len({(r["a"], r["b"]) for r in rows if r["share"] > options.max_share
                       or r["depth_m"] > options.max_depth})
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(table, file, indent=1)
    if beyond:
        print(f"{beyond} pairs overlap by more than {100 * options.max_share:g} % of a floe or "
              f"{options.max_depth:g} m")
    sys.exit(1 if beyond else 0)


if __name__ == "__main__":
    main()
