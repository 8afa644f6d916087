# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of an ice field and its report against the polygons that it was made from."""
import json

import h5py
import numpy as np

from solids import moments, polygon_area, prism

FIELD, REPORT = "field.h5", "icefield.json"
THICKNESS, RADIUS, SPACING, MOVED = 0.3, 0.075, 0.1, (2.0, 0.5)
DRIFT = (2.0, 0.5)  # where the field of the runs begins
# three floes without symmetry, in one row along x; all counterclockwise
OUTLINES = [
    [(0.0, -0.6), (0.9, -0.5), (1.0, 0.3), (0.2, 0.7)],
    [(1.3, -0.7), (2.1, -0.6), (2.3, 0.2), (1.7, 0.8), (1.2, 0.4)],
    [(2.6, -0.5), (3.6, -0.4), (3.0, 0.6)],
]


def make(work):
    rows = [f"{name},{x},{y}" for name, outline in zip("abc", OUTLINES) for x, y in outline]
    work.write("outlines.csv", "floe,x,y\n" + "\n".join(rows) + "\n")
    work.write("floes.toml", f"""pattern = "polygons"
seed = 5
[ice]
thickness = {THICKNESS}
[spheres]
radius = {RADIUS}
spacing = {SPACING}
mode = "fill"
[area]
origin = [{MOVED[0]}, {MOVED[1]}]
[floes]
file = "outlines.csv"
[edges]
breadth = 0.8
piece = 2.0
ahead = 0.0
gap = 0.1
""")
    work.run("icefield", "floes.toml", "-o", "floes.h5", "--json", "floes.json")
    work.field_command = work.last
    text = (work / "floes.toml").read_text(encoding="utf-8")
    work.write("free.toml", text[:text.index("[edges]")])
    work.run("icefield", "free.toml", "-o", "free.h5")
    work.files.setdefault(FIELD, []).append(work / "floes.h5")
    work.files.setdefault(REPORT, []).append(work / "floes.json")


def check(work, values):
    report = json.loads((work / "floes.json").read_text(encoding="utf-8"))
    with h5py.File(work / "floes.h5") as file:
        check_head(work, values, file)
        free = check_floes(values, file)
        check_shapes(values, file, free)
        check_surface(values, file)
        check_report(values, file, report, free)


def check_head(work, values, file):
    text = (work / "floes.toml").read_text(encoding="utf-8")
    for name, want in (("format", "icesolve-field"), ("format_version", 1), ("units", "SI"),
                       ("radius", RADIUS), ("spacing", SPACING), ("mode", "fill"), ("seed", 5),
                       ("specification", text), ("command_line", work.field_command),
                       ("sealed", 1)):
        values.equal(FIELD, "/@" + name, file.attrs[name], want)
    values.equal(FIELD, "/@created_by", file.attrs["created_by"].split()[0], "icefield")


def check_floes(values, file):
    """Each floe's prism, moved to its place, is its polygon: the rows of the free floes."""
    fixed = file["floe/fixed"][()]
    free = np.flatnonzero(fixed == 0)
    values.equal(FIELD, "/floe/fixed", len(free), len(OUTLINES))
    shape, place = file["floe/shape"][()], file["floe/position"][()]
    turn = file["floe/orientation"][()]
    starts = np.concatenate([[0], np.cumsum(file["shape/vertices"][()])])
    every = file["mesh/vertices"][()]
    low = np.min([p for outline in OUTLINES for p in outline], axis=0)
    high = np.max([p for outline in OUTLINES for p in outline], axis=0)
    shift = np.array(MOVED)
    for floe, outline in zip(free, OUTLINES):
        volume, _, centroid, _ = moments(prism(outline, -THICKNESS / 2, THICKNESS / 2))
        k = shape[floe]
        own = every[starts[k]:starts[k + 1]]
        w, x, y, z = turn[floe]
        values.close(FIELD, "/floe/orientation", [x, y, w * w + z * z], [0.0, 0.0, 1.0], 1e-12)
        around = np.array([[w * w - z * z, -2 * w * z], [2 * w * z, w * w - z * z]])
        # a body's origin in its mesh is its centre of mass
        lies = (own[:, :2] - file["shape/centroid"][k][:2]) @ around.T + place[floe]
        corners = {tuple(np.round(p, 9)) for p in lies}
        values.equal(FIELD, "/mesh/vertices", corners,
                     {tuple(np.round(np.array(p) + shift, 9)) for p in outline})
        values.close(FIELD, "/mesh/vertices", np.ptp(own[:, 2]), THICKNESS, 1e-12)
        values.close(FIELD, "/floe/position", place[floe], centroid[:2] + shift, 1e-9)
        values.close(FIELD, "/floe/shape", file["shape/volume"][k], volume, 1e-9)
        values.close(FIELD, "/shape/volume", file["shape/volume"][k], volume, 1e-9)
    size = high - low
    area = file.attrs["area"]
    values.close(FIELD, "/@area", area, [*(low + shift), *(high + shift)], 1e-9)
    covered = sum(map(polygon_area, OUTLINES))
    values.close(FIELD, "/@concentration", file.attrs["concentration"], covered / np.prod(size),
                 1e-9)
    return free


def check_shapes(values, file, free):
    """Integrals of each shape are those of its own mesh by another formula, those of its spheres'
    shares, too."""
    counts = {n: file["shape/" + n][()] for n in
              ("spheres", "surface_spheres", "creases", "vertices", "triangles")}
    at = {n: np.concatenate([[0], np.cumsum(c)]) for n, c in counts.items()}
    vertices, triangles = file["mesh/vertices"][()], file["mesh/triangles"][()]
    center, share = file["sphere/center"][()], file["sphere/volume"][()]
    area = file["surface/area"][()]
    arrays = {"spheres": (center, share), "surface_spheres": (area, file["surface/normal"],
              file["surface/normal_spread"]), "creases": (file["crease/sphere"],
              file["crease/normal"]), "vertices": (vertices,), "triangles": (triangles,)}
    for name, rows in arrays.items():
        values.equal(FIELD, "/shape/" + name, {len(r) for r in rows}, {int(counts[name].sum())})
    for k in range(len(counts["spheres"])):
        own = {n: slice(a[k], a[k + 1]) for n, a in at.items()}
        solid = (vertices[own["vertices"]], {"all": triangles[own["triangles"]]})
        volume, surface, centroid, inertia = moments(solid)
        values.close(FIELD, "/mesh/triangles", file["shape/volume"][k], volume, 1e-9)
        values.close(FIELD, "/shape/area", file["shape/area"][k], surface, 1e-9)
        values.close(FIELD, "/shape/centroid", file["shape/centroid"][k], centroid, margin=1e-9)
        values.close(FIELD, "/shape/inertia", file["shape/inertia"][k].reshape(3, 3), inertia, 1e-9)
        values.close(FIELD, "/sphere/volume", share[own["spheres"]].sum(), volume, 1e-9)
        values.close(FIELD, "/sphere/center", share[own["spheres"]] @ center[own["spheres"]],
                     volume * centroid, margin=1e-9)
        values.close(FIELD, "/surface/area", area[own["surface_spheres"]].sum(), surface, 1e-6)
    values.equal(FIELD, "/floe/shape", len(set(file["floe/shape"][()][free])), len(OUTLINES))


def check_surface(values, file):
    """A surface sphere touches each face whose normal it has, from inside: its centre lies R behind
    the plane through the vertices farthest along that normal."""
    counts = {n: file["shape/" + n][()] for n in ("spheres", "surface_spheres", "creases",
                                                  "vertices")}
    at = {n: np.concatenate([[0], np.cumsum(c)]) for n, c in counts.items()}
    vertices, center = file["mesh/vertices"][()], file["sphere/center"][()]
    normal, spread = file["surface/normal"][()], file["surface/normal_spread"][()]
    sphere, crease = file["crease/sphere"][()], file["crease/normal"][()]
    for k in range(len(counts["spheres"])):
        corners = vertices[at["vertices"][k]:at["vertices"][k + 1]]
        first, surface = at["spheres"][k], at["surface_spheres"][k]
        rows = slice(at["creases"][k], at["creases"][k + 1])
        behind = lambda n, s: np.max(corners @ n) - center[first + s] @ n
        creased = set(sphere[rows])
        flat = [s for s in range(counts["surface_spheres"][k]) if s not in creased]
        values.close(FIELD, "/surface/normal", [behind(normal[surface + s], s) for s in flat],
                     np.full(len(flat), RADIUS), 1e-5)
        values.close(FIELD, "/surface/normal_spread", spread[[surface + s for s in flat]],
                     np.zeros(len(flat)), margin=1e-6)
        values.close(FIELD, "/crease/normal",
                     [behind(n, s) for n, s in zip(crease[rows], sphere[rows])],
                     np.full(len(sphere[rows]), RADIUS), 1e-5)
        for s in creased:
            faces = crease[rows][sphere[rows] == s]
            if len(faces) == 2:  # the middle of two normals, half of their angle
                values.close(FIELD, "/crease/sphere", normal[surface + s],
                             faces.sum(axis=0) / np.linalg.norm(faces.sum(axis=0)), 1e-5)
                values.close(FIELD, "/surface/normal_spread", spread[surface + s],
                             np.arccos(faces[0] @ faces[1]) / 2, 1e-5)


def check_report(values, file, report, free):
    sizes = sorted(2 * np.sqrt(polygon_area(outline) / np.pi) for outline in OUTLINES)
    pieces = len(file["floe/fixed"]) - len(free)
    spheres, surface = file["shape/spheres"][()], file["shape/surface_spheres"][()]
    # spheres of the field: each floe has those of its shape
    shape = file["floe/shape"][()]
    for name, want in (("schema", "icefield/1"), ("floes", len(OUTLINES)),
                       ("unbroken_pieces", pieces), ("shapes", len(spheres)),
                       ("spheres", int(spheres[shape].sum())),
                       ("surface_spheres", int(surface[shape].sum())),
                       ("corners", count_corners(file))):
        values.equal(REPORT, name, report[name], want)
    for name, want in (("smallest_size_m", sizes[0]), ("largest_size_m", sizes[-1]),
                       ("mean_size_m", np.mean(sizes)),
                       ("concentration", file.attrs["concentration"])):
        values.close(REPORT, name, report[name], want, 1e-9)
    for stage, seconds in report["seconds"].items():
        values.within(REPORT, "seconds.<stage>", seconds, 0.0, 600.0)


def count_corners(file):
    """Each polygon has twice as many corners as its outline has; a shape counts once."""
    return int(file["shape/vertices"][()].sum())
