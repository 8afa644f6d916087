# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of sphere sets and their certificates against the tetrahedron's own, and against what
numpy makes of the set's spheres."""
import hashlib
import json

import h5py
import numpy as np

from solids import CORNER, LEGS, moments, tetrahedron

RADIUS, SPACING, DRAUGHT, ICE = 0.05, 0.06, 0.3, 0.2
# outward normals of back, side, bottom and slope
FACES = np.vstack([-np.eye(3), 1 / LEGS / np.linalg.norm(1 / LEGS)])
SET, REPORT, TABLE = "spheres.h5", "spherize.json", "spheres.csv"


def make(work):
    work.mesh("tetrahedron.obj", tetrahedron())
    work.run("spherize", "tetrahedron.obj", "-r", RADIUS, "-s", SPACING, "-o",
             "tetrahedron.spheres.h5", "--json", "tetrahedron.json", "--draught", DRAUGHT,
             "--ice-thickness", ICE, "--export", "csv")
    work.command = work.last
    vertices, groups = tetrahedron()
    groups["slope"] = [t[::-1] for t in groups["slope"]]
    work.mesh("turned.obj", (vertices, groups))
    work.turned = work.run("spherize", "turned.obj", "-r", RADIUS, "-o", "turned.h5", "--json",
                           "turned.json")
    work.files.setdefault(REPORT, []).append(work / "turned.json")
    work.files.setdefault(SET, []).append(work / "tetrahedron.spheres.h5")
    work.files.setdefault(REPORT, []).append(work / "tetrahedron.json")
    work.files.setdefault(TABLE, []).append(work / "tetrahedron.spheres.csv")


def distance_inside(points):
    """How far points lie behind each face, [n, 4]: back x, side y, bottom z, slope."""
    local = points - CORNER
    slope = 1 / LEGS / np.linalg.norm(1 / LEGS)
    return np.column_stack([local, (slope @ np.diag(LEGS))[0] - local @ slope])


def check(work, values):
    report = json.loads((work / "tetrahedron.json").read_text(encoding="utf-8"))
    with h5py.File(work / "tetrahedron.spheres.h5") as file:
        check_head(work, values, file, report)
        check_solid(values, file, report)
        check_rows(values, file)
        check_counts(values, file, report)
        check_quality(values, file, report)
        check_table(work, values, file)


def check_head(work, values, file, report):
    sha = hashlib.sha256((work / "tetrahedron.obj").read_bytes()).hexdigest()
    for name, want in (("format", "icesolve-spheres"), ("format_version", 1), ("units", "SI"),
                       ("dimension", 3), ("radius", RADIUS), ("spacing", SPACING),
                       ("mode", "fill"), ("source_mesh", "tetrahedron.obj"),
                       ("source_sha256", sha), ("sealed", 1), ("draught", DRAUGHT),
                       ("ice_thickness", ICE), ("repairs", 0), ("command_line", work.command),
                       ("ice_belt", report["ice_belt"]["text"])):
        values.equal(SET, "/@" + name, file.attrs[name], want)
    values.equal(SET, "/@created_by", file.attrs["created_by"].split()[0], "spherize")
    stored = json.loads(file.attrs["certificate"])
    values.equal(SET, "/@certificate", {**stored, "seconds": 0}, {**report, "seconds": 0})
    for name, want in (("schema", "spherize/1"), ("dimension", 3), ("radius_m", RADIUS),
                       ("spacing_m", SPACING), ("source_mesh", "tetrahedron.obj"),
                       ("command_line", work.command)):
        values.equal(REPORT, name, report[name], want)
    check_repairs(work, values)
    values.equal(REPORT, "guessed.<guess>", report["guessed"],
                 {"forward": "+x", "units": "m, as the file has them", "up": "z"})
    work.check_origin(values, REPORT, report)
    seconds = report["seconds"]
    parts = sum(v for k, v in seconds.items() if k != "total")
    values.within(REPORT, "seconds.<stage>", parts, 0.0, 1.001 * seconds["total"])


def check_repairs(work, values):
    """One triangle faces inwards; with the others it makes the same solid."""
    report = json.loads((work / "turned.json").read_text(encoding="utf-8"))
    (repair,) = report["repairs"]
    values.equal(REPORT, "ice_belt", report["ice_belt"], None)  # without --draught
    values.equal(REPORT, "repairs[].count", repair["count"], 1)
    values.equal(REPORT, "repairs[].step", "turn" in repair["step"] or "orient" in repair["step"],
                 True)
    with h5py.File(work / "turned.h5") as file:
        values.equal(SET, "/@repairs", file.attrs["repairs"], 1)
        values.close(SET, "/solid@volume", file["solid"].attrs["volume"], np.prod(LEGS) / 6, 1e-12)


def check_solid(values, file, report):
    """By hand: V = a b c / 6, centroid a quarter of the legs from the corner, and about it
    int x y dV = -V a b / 80, so the tensor's I_xy = V a b / 80."""
    volume, area, centroid, inertia = moments(tetrahedron())
    a, b, c = LEGS
    values.close(REPORT, "volume_m3", report["volume_m3"], a * b * c / 6, 1e-14)
    values.close(REPORT, "centroid_m", report["centroid_m"], CORNER + LEGS / 4, 1e-14)
    square = 3 * volume / 80
    by_hand = [square * (b * b + c * c), square * (a * a + c * c), square * (a * a + b * b),
               volume * a * b / 80, volume * a * c / 80, volume * b * c / 80]
    values.close(REPORT, "inertia_unit_density", report["inertia_unit_density"], by_hand, 1e-12)
    values.close(REPORT, "area_m2", report["area_m2"], area, 1e-14)
    solid = file["solid"].attrs
    for name, want in (("volume", volume), ("area", area), ("centroid", centroid),
                       ("inertia", inertia)):
        values.close(SET, "/solid@" + name, solid[name], want, 1e-12)
    corners = {tuple(v) for v in file["mesh/vertices"][()]}
    values.equal(SET, "/mesh/vertices", corners, {tuple(v) for v in tetrahedron()[0]})
    names = [n.decode() for n in file["region_names"][()]]
    values.equal(SET, "/region_names", set(names) - {"hull"}, {"back", "side", "bottom", "slope"})
    outward = {"back": (-1, 0, 0), "side": (0, -1, 0), "bottom": (0, 0, -1),
               "slope": tuple(1 / LEGS / np.linalg.norm(1 / LEGS))}
    vertices, triangles = file["mesh/vertices"][()], file["mesh/triangles"][()]
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    want = [outward[names[r]] for r in file["mesh/region"][()]]
    values.close(SET, "/mesh/triangles", normal, want, 1e-12)
    values.close(SET, "/mesh/region", normal, want, 1e-12)


def check_rows(values, file):
    """Shares add up; each sphere of the surface touches the faces that its normals say."""
    center, radius = file["center"][()], file["radius"][()]
    volume, area, centroid, _ = moments(tetrahedron())
    share = file["volume"][()]
    values.close(SET, "/volume", [share.sum(), *(share @ center)], [volume, *(volume * centroid)],
                 1e-9)
    surface = file["layer"][()] == 1
    values.close(SET, "/area", file["area"][()].sum(), area, 1e-9)
    values.close(SET, "/area", file["area"][()][~surface], np.zeros((~surface).sum()))
    values.equal(SET, "/radius", np.unique(radius), np.array([RADIUS]))
    behind = distance_inside(center)
    touching = np.abs(behind - RADIUS) < 1e-9
    values.close(SET, "/center", behind.min(axis=1)[surface], np.full(surface.sum(), RADIUS), 1e-9)
    values.equal(SET, "/layer", [touching[surface].any(axis=1).all(), surface[:surface.sum()].all(),
                                 (behind[~surface] > RADIUS - 1e-9).all()], [True, True, True])
    faces = FACES
    sphere, normal = file["crease/sphere"][()], file["crease/normal"][()]
    values.equal(SET, "/crease/sphere", sphere, np.array(
        [s for s in range(surface.sum()) for _ in range(touching[s].sum())
         if touching[s].sum() > 1]))
    order = lambda rows: np.lexsort(np.round(np.asarray(rows), 5).T)
    flat = touching.sum(axis=1)[:surface.sum()] == 1
    one = np.argmax(touching[:surface.sum()], axis=1)
    stored = file["normal"][()]
    values.close(SET, "/normal", stored[:surface.sum()][flat], faces[one[flat]], 1e-6)
    values.close(SET, "/normal", stored[~surface], np.zeros(((~surface).sum(), 3)))
    for s in np.unique(sphere):
        rows, want = normal[sphere == s], faces[touching[s]]
        values.close(SET, "/crease/normal", rows[order(rows)], want[order(want)], 1e-6)
        # the middle of two normals, and half of the angle between them
        if len(want) == 2:
            middle = want.sum(axis=0) / np.linalg.norm(want.sum(axis=0))
            values.close(SET, "/normal", stored[s], middle, 1e-5)
            values.close(SET, "/normal_spread", file["normal_spread"][s],
                         np.arccos(want[0] @ want[1]) / 2, 1e-5)
    names = [n.decode() for n in file["region_names"][()]]
    region = [("back", "side", "bottom", "slope").index(names[r])
              for r in file["region"][()][:surface.sum()][flat]]
    values.equal(SET, "/region", np.array(region), one[flat])


def check_counts(values, file, report):
    count, on_surface = len(file["center"]), int((file["layer"][()] == 1).sum())
    values.equal(REPORT, "spheres", report["spheres"], count)
    values.equal(REPORT, "surface_spheres", report["surface_spheres"], on_surface)
    # a centre and a volume, four numbers of 8 bytes
    values.equal(REPORT, "interior_bytes", report["interior_bytes"], 32 * (count - on_surface))
    values.equal(SET, "/@spheres", file.attrs["spheres"], count)
    values.equal(SET, "/@surface_spheres", file.attrs["surface_spheres"], on_surface)
    # three faces meet in each of the tetrahedron's four corners, and each has a sphere
    values.equal(REPORT, "corners", report["corners"], 4)
    values.equal(REPORT, "blind_corners", report["blind_corners"], 0)
    values.equal(REPORT, "outside_dropped", report["outside_dropped"], 0)
    values.equal(SET, "/@thin_features", file.attrs["thin_features"], len(report["thin_features"]))


def check_quality(values, file, report):
    center = file["center"][()][file["layer"][()] == 1]
    # spheres touch from inside, with normals of the faces
    values.close(REPORT, "protrusion_max_m", report["protrusion_max_m"], 0.0, margin=1e-12)
    for name in ("normal_error_mean_deg", "normal_error_p99_deg"):
        values.close(REPORT, name, report[name], 0.0, margin=1e-4)
        values.close(SET, "/@" + name, file.attrs[name], 0.0, margin=1e-4)
    points, faces, gaps = gaps_of_surface(center)
    # samples of ours and of the program differ; the largest is in a corner, which samples miss by
    # a part of the spacing
    inner = (np.abs(points[:, None] - tetrahedron()[0]).max(axis=2) > 0).all(axis=1)  # no corner
    for name, share in (("gap_p50_m", 50), ("gap_p99_m", 99), ("gap_max_m", 100)):
        margin = SPACING / 10 if share < 100 else SPACING / 3
        values.close(REPORT, name, report[name], np.percentile(gaps[inner], share) if share < 100
                     else gaps.max(), margin=margin)
        values.equal(SET, "/@" + name, file.attrs[name], report[name])
    # the worst place is a point of a face; a sphere that touches there has its centre R behind
    at = np.array(report["covering_at_m"])
    behind = distance_inside(at[None])[0]
    values.close(REPORT, "covering_at_m", behind.min(), 0.0, margin=1e-6)
    middle = at - RADIUS * FACES[behind.argmin()]
    values.close(REPORT, "covering_radius_m", report["covering_radius_m"],
                 np.linalg.norm(center - middle, axis=1).min(), 1e-3)
    # of the wetted surface, the part that no sphere can touch without reaching through another
    # face, and that is over half a radius from all, which may stand aside by 0.65 of the spacing;
    # 9000 samples give it to 0.01
    far = np.hypot(1.5 * RADIUS, 0.65 * SPACING) - RADIUS
    fits = distance_inside(points - RADIUS * FACES[faces]).min(axis=1) > RADIUS - 1e-9
    wet = points[:, 2] < CORNER[2] + DRAUGHT
    values.close(REPORT, "unfitted_share", report["unfitted_share"],
                 np.mean((gaps > far)[wet] & ~fits[wet]), margin=0.01)
    for name in ("covering_radius_m", "protrusion_max_m", "unfitted_share"):
        values.equal(SET, "/@" + name, file.attrs[name], report[name])
    check_belt(values, file, report)
    check_thin(values, report)


def gaps_of_surface(center):
    """Points all over the surface, their face, and how far the nearest sphere's surface is [m]."""
    vertices, groups = tetrahedron()
    dice = np.random.default_rng(1)
    points, faces = [], []
    for face, ((i, j, k),) in enumerate(groups.values()):
        a, b, c = vertices[[i, j, k]]
        area = np.linalg.norm(np.cross(b - a, c - a)) / 2
        u, v = dice.random((2, int(4000 * area)))
        u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
        points.append(np.vstack([a + u[:, None] * (b - a) + v[:, None] * (c - a), a, b, c]))
        faces += [face] * len(points[-1])
    points = np.vstack(points)
    gaps = np.array([np.linalg.norm(center - p, axis=1).min() for p in points]) - RADIUS
    return points, np.array(faces), gaps


def check_belt(values, file, report):
    """Two ice thicknesses about the water 0.3 m over the lowest point, z = 1."""
    belt = report["ice_belt"]
    values.equal(REPORT, "ice_belt.draught_m", belt["draught_m"], DRAUGHT)
    values.equal(REPORT, "ice_belt.ice_thickness_m", belt["ice_thickness_m"], ICE)
    water = CORNER[2] + DRAUGHT
    values.close(REPORT, "ice_belt.z_m", belt["z_m"], [water - 2 * ICE, water + 2 * ICE], 1e-12)
    for part in ("p99", "max"):
        values.within(REPORT, f"ice_belt.gap_{part}_m", belt[f"gap_{part}_m"],
                      0.0, report["gap_max_m"])
    text = belt["text"]
    values.equal(REPORT, "ice_belt.text", ["z 0.9 to 1.7 m" in text, "draught 0.3 m" in text], [
        True, True])
    # nothing was repaired: the mesh is its own solid
    for group, name in ((belt, "ice_belt."), (report["source"], "source.")):
        for direction in ("to_solid", "from_solid"):
            for key in ("p50_m", "p99_m", "max_m"):
                values.equal(REPORT, f"{name}{direction}.{key}", group[direction][key], 0.0)
            values.equal(REPORT, f"{name}{direction}.at_m", group[direction]["at_m"],
                         [0.0, 0.0, 0.0])
    for key in ("caps_m2", "left_out_m2"):
        values.equal(REPORT, "source." + key, report["source"][key], 0.0)
    for key in ("p99", "max"):
        values.equal(SET, f"/@source_distance_{key}_m", file.attrs[f"source_distance_{key}_m"], 0.0)


def check_thin(values, report):
    """No sphere reaches into the sharp ends of x and y, nor does the keel's end: the section at the
    keel, 45 degrees and 50 degrees."""
    thin = report["thin_features"]
    ends = sorted(np.linalg.norm(np.array(t["at_m"]) - CORNER - np.diag(LEGS), axis=1).argmin()
                  for t in thin)
    values.equal(REPORT, "thin_features[].at_m", ends, sorted(set(ends)))
    for t in thin:
        behind = distance_inside(np.array(t["at_m"])[None])[0]
        values.within(REPORT, "thin_features[].size_m", t["size_m"], 0.0, 2 * RADIUS)
        values.within(REPORT, "thin_features[].at_m", behind.min(), -RADIUS / 10, RADIUS)
    values.equal(REPORT, "warnings", any("too thin" in w and str(len(thin)) in w
                                         for w in report["warnings"]), bool(thin))
    for cut in report["cut_back"]:
        values.equal(REPORT, "cut_back[].part", cut["part"] in ("stem", "stern", "keel"), True)
        values.within(REPORT, "cut_back[].by_m", cut["by_m"], 0.0, LEGS.max() / 3)
        values.within(REPORT, "cut_back[].from_m", cut["from_m"], CORNER.min(), 4.2)
        values.within(REPORT, "cut_back[].to_m", cut["to_m"], cut["from_m"], 4.2)
        values.equal(REPORT, "cut_back[].text", cut["part"] in cut["text"], True)


def check_table(work, values, file):
    """The CSV has a row for each sphere, with the set's numbers in all their digits."""
    rows = (work / "tetrahedron.spheres.csv").read_text(encoding="utf-8").splitlines()
    cells = [row.split(",") for row in rows[1:]]
    names = [n.decode() for n in file["region_names"][()]]
    columns = {"x_m": file["center"][:, 0], "y_m": file["center"][:, 1],
               "z_m": file["center"][:, 2], "radius_m": file["radius"][()],
               "nx": file["normal"][:, 0], "ny": file["normal"][:, 1],
               "nz": file["normal"][:, 2], "layer": file["layer"][()]}
    for k, name in enumerate(rows[0].split(",")):
        column = [row[k] for row in cells]
        if name == "region":
            on_surface = file["layer"][()] == 1
            values.equal(TABLE, name, np.array(column)[on_surface],
                         np.array([names[r] for r in file["region"][()]])[on_surface])
        else:
            values.close(TABLE, name, np.array(column, float), columns[name], 1e-6)
