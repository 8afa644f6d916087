#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""make_drawings.py [--check]: the drawings of docs/method.md, as SVG beside it in docs/method/.

With --check nothing is written; the exit code is 1 where a file is not what would be written."""
import math
import pathlib
import sys

from drawing import (FAINT, FORCE, GOOD, HULL, HULL_LINE, ICE, ICE_LINE, NOTE, Drawing)


def step():
    d = Drawing(1000, 330)
    stages = [("pairs,\ncontacts", HULL), ("impacts", "#f6d9d6"), ("loads", "#d8e9d8"),
              ("rest", "#f6d9d6"), ("overlap,\ncrushing", "#efe4c8"), ("move", ICE)]
    x0, width, gap = 70, 118, 32
    for k, (name, colour) in enumerate(stages):
        x = x0 + k * (width + gap)
        d.polygon([(x, 120), (x + width, 120), (x + width, 180), (x, 180)], colour, HULL_LINE, 1.2)
        lines = name.count("\n")
        d.text(x + width / 2, 155 - 9 * lines, name, size=15, bold=True)
        if k:
            d.arrow(x - gap, 150, x, 150, HULL_LINE, 1.6)
    at = [x0 - gap / 2 + k * (width + gap) for k in range(7)]
    velocities = ["vⁿ", "vⁿ", "v′", "v″", "vⁿ⁺¹", "vⁿ⁺¹", "vⁿ⁺¹"]
    for k, name in enumerate(velocities):
        if k in (0, 1, 2, 3, 4, 6):
            d.text(at[k], 100 if k else 155, name, FORCE, 17, bold=True)
            if 0 < k < 6:
                d.path([(at[k], 106), (at[k], 142)], FORCE, 1, "3 3")
    d.text(30, 62, "velocity", FORCE, 14, "start", True)
    d.text(x0 + 1.5 * width + gap, 62, "restitution acts on vⁿ", FORCE, 13)
    d.text(x0 + 2.5 * width + 2 * gap, 40, "drag takes v′", FORCE, 13)
    d.text(x0 + 3.5 * width + 3 * gap, 62, "carries the loads", FORCE, 13)
    for k in (1, 2, 3):
        x = x0 + k * (width + gap) + width / 2
        d.path([(x, 68 if k != 2 else 46), (x, 116)], FORCE, 1, "2 3")
    d.text(30, 232, "pose", ICE_LINE, 14, "start", True)
    d.arrow(x0, 228, x0 + 5 * (width + gap) + 4, 228, ICE_LINE, 2.2)
    d.text(x0 + 2.5 * (width + gap), 222, "xⁿ, qⁿ: geometry and loads of the whole step", ICE_LINE)
    d.arrow(x0 + 5 * (width + gap) + 8, 228, x0 + 6 * width + 5 * gap, 228, ICE_LINE, 2.2)
    d.text(x0 + 5 * (width + gap) + width / 2, 218, "xⁿ⁺¹, qⁿ⁺¹", ICE_LINE, 14)
    d.text(30, 288, "force", NOTE, 14, "start", True)
    for k in (1, 3):
        x = x0 + k * (width + gap) + width / 2
        d.path([(x, 184), (x, 212)], NOTE, 1, "2 3")
        d.path([(x, 236), (x, 270)], NOTE, 1, "2 3")
        d.text(x, 288, "Jⁱ" if k == 1 else "Jʳ", NOTE, 16, bold=True)
    d.text(x0 + 5 * (width + gap), 288, "reported force on the ship: −Σ (Jⁱ + Jʳ) / dt")
    d.path([(x0 + 3.5 * (width + gap), 284), (x0 + 3.5 * (width + gap) + 32, 284)], NOTE, 1)
    return d


def cone(d, x, y, r, normals, colour=FORCE):
    """A normal cone on the circle of directions."""
    d.circle(x, y, r, "#fafafa", FAINT, 1)
    for a in normals:
        ux, uy = math.cos(math.radians(a)), math.sin(math.radians(a))
        d.arrow(x, y, x + r * ux, y - r * uy, colour, 1.8)
    if len(normals) == 2:
        d.arc(x, y, r, normals[0], normals[1], colour, 4)


def features():
    d = Drawing(1000, 400)
    r = 52
    # face
    x, y = 165, 190
    d.polygon([(45, y - r), (285, y - r), (285, y + 75), (45, y + 75)])
    d.circle(x, y, r, "#eef7fc", FAINT)
    d.dot(x, y)
    d.text(x + 12, y + 20, "c")
    d.arrow(x, y - r, x, y - r - 52)
    d.text(x + 16, y - r - 38, "n", FORCE, 16)
    d.dot(x, y - r, FORCE)
    d.text(x - 12, y - r - 10, "s(n) = c + r n", FORCE, 13, "end")
    d.text(165, 40, "face: one normal", size=17, bold=True)
    cone(d, 165, 350, 30, [90])
    d.text(240, 355, "a point", FORCE, 13)
    # edge
    x, y = 500, 205
    tip = (x, y - r * math.sqrt(2))
    side = tip[1] + 130
    d.polygon([tip, (x + 130, side), (x + 130, 270), (x - 130, 270), (x - 130, side)])
    d.circle(x, y, r, "#eef7fc", FAINT)
    d.dot(x, y)
    d.path([(x, y), tip], FAINT, 1.2, "4 3")
    for sign in (-1, 1):
        px, py = x + sign * r / math.sqrt(2), y - r / math.sqrt(2)
        d.dot(px, py, FAINT)
        d.arrow(px, py, px + sign * 36, py - 36)
    d.dot(*tip, FORCE)
    d.text(x, tip[1] - 14, "s(n) = c + (r / cos a) m", FORCE, 13)
    d.text(x + 14, y - 20, "m", NOTE, 13)
    d.text(500, 40, "edge: two normals", size=17, bold=True)
    cone(d, 500, 350, 30, [45, 135])
    d.text(572, 355, "an arc", FORCE, 13)
    # vertex, a corner of a box in oblique view
    x, y = 830, 175
    right, left, down = (108, 42), (-108, 42), (0, 105)
    def at(*parts):
        return (x + sum(p[0] for p in parts), y - 48 + sum(p[1] for p in parts))
    d.polygon([at(), at(right), at(right, left), at(left)], "#e6f3fa")
    d.polygon([at(left), at(right, left), at(right, left, down), at(left, down)], ICE)
    d.polygon([at(right), at(right, left), at(right, left, down), at(right, down)], "#c2def0")
    vx, vy = at(right, left)
    d.circle(vx, vy + 44, 40, "none", FAINT, 1.2, "4 3")
    d.dot(vx, vy + 44, FAINT)
    d.arrow(x, y - 18, x, y - 82)
    d.arrow(x - 58, y + 74, x - 112, y + 110)
    d.arrow(x + 58, y + 74, x + 112, y + 110)
    d.dot(vx, vy, FORCE, 4)
    d.text(vx + 20, vy - 10, "s(n)", FORCE, 13, "start")
    d.text(830, 40, "vertex: three normals", size=17, bold=True)
    d.circle(830, 350, 30, "#fafafa", FAINT, 1)
    d.polygon([(830, 325), (809, 366), (851, 366)], "#f3c9c6", FORCE, 1.6)
    d.text(872, 355, "a triangle", FORCE, 13, "start")
    d.text(30, 355, "normal cone", NOTE, 13, "start")
    return d


def axes():
    d = Drawing(1000, 330)
    # face on face
    d.text(165, 34, "face on face", size=17, bold=True)
    d.polygon([(40, 60), (290, 60), (290, 150), (40, 150)], HULL, HULL_LINE)
    d.polygon([(60, 176), (270, 176), (270, 260), (60, 260)])
    d.circle(165, 110, 40, "#f3f3f3", FAINT)
    d.circle(190, 212, 36, "#eef7fc", FAINT)
    d.dot(190, 176, ICE_LINE)
    d.arrow(190, 152, 190, 174, FORCE, 1.8, True)
    d.text(210, 168, "gap", FORCE, 13, "start")
    d.arrow(90, 150, 90, 200)
    d.text(104, 196, "n", FORCE, 16)
    d.text(165, 290, "axis: the face's normal", size=14)
    # edge on face
    d.text(500, 34, "edge on face", size=17, bold=True)
    d.polygon([(375, 60), (625, 60), (625, 150), (375, 150)], HULL, HULL_LINE)
    tip = (510, 172)
    d.polygon([tip, (600, 214), (566, 278), (400, 240), (420, 202)])
    d.circle(480, 110, 40, "#f3f3f3", FAINT)
    d.circle(512, 206, 28, "#eef7fc", FAINT)
    d.dot(*tip, ICE_LINE)
    d.arrow(510, 152, 510, 171, FORCE, 1.8, True)
    d.text(524, 168, "gap", FORCE, 13, "start")
    d.arrow(425, 150, 425, 196)
    d.text(440, 190, "n", FORCE, 16)
    d.text(500, 305, "axis: the face's normal;\nthe edge's tip is the incident point", size=14)
    # edge across edge, oblique
    d.text(835, 34, "edge across edge", size=17, bold=True)
    d.polygon([(700, 118), (960, 118), (940, 74), (720, 74)], HULL, HULL_LINE)
    d.polygon([(700, 118), (960, 118), (930, 92), (745, 92)], "#cfcfcf", HULL_LINE, 1)
    d.polygon([(765, 250), (900, 150), (945, 205), (815, 290)])
    d.polygon([(765, 250), (900, 150), (880, 200), (800, 275)], "#bcdcef", ICE_LINE, 1)
    d.path([(700, 118), (960, 118)], HULL_LINE, 3)
    d.path([(765, 250), (900, 150)], ICE_LINE, 3)
    d.dot(836, 118, HULL_LINE)
    d.dot(836, 197, ICE_LINE)
    d.arrow(836, 122, 836, 193, FORCE, 1.8, True)
    d.text(848, 152, "gap", FORCE, 13, "start")
    d.text(730, 140, "e_a", HULL_LINE, 14)
    d.text(762, 226, "e_b", ICE_LINE, 14)
    d.text(835, 312, "axis: e_a × e_b", size=14)
    return d


def reduction():
    d = Drawing(1000, 340)
    d.text(165, 34, "patch radius", size=17, bold=True)
    d.polygon([(35, 60), (295, 60), (295, 290), (35, 290)], HULL, HULL_LINE)
    for i in range(4):
        for j in range(3):
            d.dot(70 + 66 * i, 108 + 66 * j, FAINT, 2.6)
    d.circle(136, 174, 50, "#f6d9d6", FORCE, 1.6)
    d.dot(136, 174, FORCE)
    d.dot(160, 150, ICE_LINE, 4.5)
    d.text(165, 316, "surface of one sphere: 0.75 spacings", size=13)
    d.text(500, 34, "side planes", size=17, bold=True)
    d.polygon([(370, 60), (520, 60), (520, 290), (370, 290)], HULL, HULL_LINE)
    for i in range(3):
        for j in range(3):
            d.dot(392 + 58 * i, 108 + 66 * j, FAINT, 2.6)
    d.circle(508, 174, 50, "none", FAINT, 1.2, "4 3")
    d.path([(520, 60), (520, 290)], FORCE, 3)
    d.dot(500, 150, ICE_LINE, 4.5)
    d.text(488, 146, "contact", GOOD, 13, "end")
    d.dot(545, 185, ICE_LINE, 4.5)
    d.text(556, 182, "none: beyond\nthe next face's\nplane", FORCE, 13, "start")
    d.text(500, 316, "within the patch radius, past the side plane", size=13)
    d.text(835, 34, "reduction", size=17, bold=True)
    d.polygon([(700, 90), (970, 90), (970, 150), (700, 150)], HULL, HULL_LINE)
    for i in range(5):
        d.circle(726 + 55 * i, 123, 26, "#f3f3f3", FAINT, 1)
        d.dot(726 + 55 * i, 150, FAINT, 2.6)
    d.polygon([(745, 160), (925, 160), (925, 230), (745, 230)])
    for i in range(3):
        x = 775 + 60 * i
        d.circle(x, 186, 25, "#eef7fc", FAINT, 1)
        d.dot(x, 160, ICE_LINE, 4)
        near = min((726 + 55 * k for k in range(5)), key=lambda a: abs(a - x))
        for k in range(5):
            at = 726 + 55 * k
            if abs(at - x) < 60:
                kept = at == near
                d.path([(at, 150), (x, 160)], GOOD if kept else "#d9a5a3", 2.5 if kept else 1.2)
    d.text(835, 258, "one contact per incident sphere\nand reference face: the nearest", size=13)
    d.text(835, 306, "of two faces that meet in a convex edge:\nthe one that is penetrated less",
           size=13)
    return d


def bumps():
    d = Drawing(1000, 300)
    for x0, name in ((20, "normal = \"centres\""), (520, "normal = \"surface\"")):
        d.text(x0 + 230, 30, name, size=16, bold=True)
        d.polygon([(x0, 50), (x0 + 460, 50), (x0 + 460, 130), (x0, 130)], HULL, HULL_LINE)
        for k in range(5):
            d.circle(x0 + 46 + 92 * k, 94, 36, "#f3f3f3", FAINT)
    # spheres of the floe lie between bumps of the hull
    d.polygon([(70, 128), (430, 128), (430, 205), (70, 205)], ICE, ICE_LINE, 1.5, 0.85)
    for k in range(4):
        x = 128 + 92 * k - 20
        d.circle(x, 160, 32, "#eef7fc", ICE_LINE, 1)
        hx, hy = 20 + 46 + 92 * k, 94
        ux, uy = x - hx, 160 - hy
        length = math.hypot(ux, uy)
        px, py = hx + 36 * ux / length, hy + 36 * uy / length
        d.arrow(px, py, px + 58 * ux / length, py + 58 * uy / length)
    d.text(250, 236, "the force leans: sliding climbs each bump", FORCE, 14)
    d.polygon([(570, 132), (930, 132), (930, 205), (570, 205)], ICE, ICE_LINE, 1.5, 0.85)
    for k in range(4):
        x = 628 + 92 * k - 20
        d.circle(x, 164, 32, "#eef7fc", ICE_LINE, 1)
        d.arrow(x, 132, x, 190)
    d.text(750, 236, "the force is normal to the bottom", FORCE, 14)
    d.arrow(300, 268, 200, 268, HULL_LINE, 1.8)
    d.text(312, 273, "floe relative to the hull", HULL_LINE, 13, "start")
    return d


def laws():
    d = Drawing(1000, 330)
    d.text(180, 32, "impacts", size=16, bold=True)
    d.text(510, 32, "rest", size=16, bold=True)
    d.text(840, 32, "friction", size=16, bold=True)
    for x0, target in ((180, "v* = −e v_r0·n"), (510, "v* = −max(gap, 0) / dt")):
        shift = 45 if x0 == 180 else -45
        d.arrow(x0 - 130, 270, x0 + 140, 270, NOTE, 1.4)
        d.text(x0 + 138, 292, "v_r·n", NOTE, 14, "end")
        d.arrow(x0, 290, x0, 60, NOTE, 1.4)
        d.text(x0 + 10, 66, "J_n", NOTE, 14, "start")
        t = x0 + shift
        d.path([(x0 - 125, 110), (t, 110), (t, 270), (x0 + 125, 270)], FORCE, 3.5)
        d.path([(t, 110), (x0 + 125, 110)], FAINT, 1, "4 3")
        bound = "B = p A dt" if x0 == 180 else "B − J_n of the impacts"
        d.text(x0 + 128, 104, bound, NOTE, 13, "end")
        d.text(t, 312, target, FORCE, 13)
        d.path([(t, 274), (t, 298)], FORCE, 1, "2 3")
        d.text(x0 - 80, 134, "crushing", FORCE, 12)
    d.circle(840, 175, 88, "#fbeceb", FORCE, 3)
    d.dot(840, 175)
    d.arrow(840, 175, 840 + 88 * math.cos(0.6), 175 - 88 * math.sin(0.6), FORCE)
    d.text(868, 140, "J_t", FORCE, 14)
    d.arrow(840, 175, 840 - 120 * math.cos(0.6), 175 + 120 * math.sin(0.6), ICE_LINE)
    d.text(742, 262, "sliding", ICE_LINE, 14, "start")
    d.text(840, 292, "radius μ J_n; on the rim where it slides,\ninside where it sticks", size=13)
    return d


def patch():
    d = Drawing(1000, 330)
    # an edge pointing up into the hull's face
    x, y, r = 330, 178, 70
    tip = (x, y - r * math.sqrt(2))
    plane = 118
    side = tip[1] + 170
    d.polygon([tip, (x + 170, side), (x + 120, 290), (x - 120, 290), (x - 170, side)])
    cut = plane - tip[1]
    d.polygon([tip, (x + cut, plane), (x - cut, plane)], "#f3c9c6", FORCE, 1.2)
    d.polygon([(60, 40), (600, 40), (600, plane), (60, plane)], HULL, HULL_LINE, 1.5, 0.55)
    d.path([(60, plane), (600, plane)], HULL_LINE, 2.5)
    d.circle(x, y, r, "none", FAINT, 1.2)
    d.dot(x, y)
    wing = 1.35 * r
    for sign in (-1, 1):
        end = (x + sign * wing / math.sqrt(2) * 1.3, tip[1] + wing / math.sqrt(2) * 1.3)
        d.path([tip, end], ICE_LINE, 5)
        d.dot(*end, ICE_LINE, 4)
    d.text(x + 112, y - 12, "wing", ICE_LINE, 14, "start")
    d.text(x - 112, y - 12, "wing", ICE_LINE, 14, "end")
    d.dot(*tip, FORCE)
    d.text(x + 12, tip[1] - 4, "foot = support point", FORCE, 13, "start")
    d.arrow(520, tip[1], 520, plane, FORCE, 1.6, True)
    d.path([tip, (530, tip[1])], FAINT, 1, "4 3")
    d.text(532, tip[1] + 24, "depth", FORCE, 13, "start")
    d.text(75, 62, "the other body", HULL_LINE, 13, "start")
    d.arrow(100, plane, 100, plane + 62)
    d.text(114, plane + 54, "n", FORCE, 16)
    low, high = plane + 24, plane + 12
    d.path([(x - cut, high), (x - cut, low), (x + cut, low), (x + cut, high)], FORCE, 1.6)
    d.text(x, plane + 42, "A", FORCE, 15, bold=True)
    # area against depth
    d.arrow(680, 270, 960, 270, NOTE, 1.4)
    d.text(958, 292, "depth", NOTE, 13, "end")
    d.arrow(680, 290, 680, 50, NOTE, 1.4)
    d.text(692, 60, "A", NOTE, 14, "start")
    d.path([(680, 262), (830, 120), (950, 120)], ICE_LINE, 3)
    d.text(846, 164, "edge: grows\nwith the depth", ICE_LINE, 13, "start")
    d.path([(680, 90), (950, 90)], GOOD, 3)
    d.text(820, 80, "flat face: whole at once", GOOD, 13)
    return d


def skin():
    d = Drawing(1000, 260)
    d.polygon([(60, 80), (220, 60), (235, 150), (75, 170)])
    d.polygon([(420, 90), (560, 75), (570, 160), (432, 175)])
    d.arrow(229, 115, 424, 125, FORCE, 2, True)
    d.text(326, 106, "clearance when last measured", FORCE, 13)
    d.arrow(150, 200, 225, 200, ICE_LINE)
    d.text(187, 225, "path of a", ICE_LINE, 13)
    d.arrow(490, 200, 432, 200, ICE_LINE)
    d.text(461, 225, "path of b", ICE_LINE, 13)
    d.path([(640, 150), (950, 150)], NOTE, 1.4)
    d.text(640, 40, "not measured while", NOTE, 15, "start", True)
    d.text(640, 66, "path of a + path of b + closing of this step", ICE_LINE, 14, "start")
    d.text(640, 88, "&lt; clearance − margin", FORCE, 14, "start")
    d.polygon([(640, 140), (790, 140), (790, 160), (640, 160)], "#c9e0ee", ICE_LINE, 1)
    d.polygon([(790, 140), (850, 140), (850, 160), (790, 160)], "#dcebf4", ICE_LINE, 1)
    d.text(715, 182, "paths so far", ICE_LINE, 12)
    d.text(826, 182, "this step", ICE_LINE, 12)
    d.path([(930, 128), (930, 172)], FORCE, 3)
    d.text(930, 120, "measure again", FORCE, 12)
    return d


DRAWINGS = {f.__name__: f for f in (step, features, axes, reduction, bumps, laws, patch, skin)}


def main():
    folder = pathlib.Path(__file__).resolve().parent / "method"
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(__doc__)
    folder.mkdir(exist_ok=True)
    stale = []
    for name, draw in DRAWINGS.items():
        path, text = folder / f"{name}.svg", draw().svg()
        if not check:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            stale.append(path.name)
    if stale:
        sys.exit(f"docs/method: {', '.join(stale)} differ; run docs/make_drawings.py")


if __name__ == "__main__":
    main()
