# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes, arrows and texts as SVG, for make_drawings.py."""
import math

ICE, ICE_LINE = "#d6ebf7", "#2b6c8f"
HULL, HULL_LINE = "#e4e4e4", "#444444"
FORCE, NOTE, FAINT = "#b8312f", "#222222", "#8a8a8a"
GOOD = "#2e7d32"


class Drawing:
    """Shapes in the order in which they are drawn; x to the right, y down, in pixels."""

    def __init__(self, width, height):
        self.size = (width, height)
        self.rows = []

    def add(self, text):
        self.rows.append(text)

    def polygon(self, points, fill=ICE, line=ICE_LINE, width=1.5, opacity=1.0):
        at = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.add(f'<polygon points="{at}" fill="{fill}" fill-opacity="{opacity}" stroke="{line}" '
                 f'stroke-width="{width}" stroke-linejoin="round"/>')

    def path(self, points, line=NOTE, width=1.5, dash=""):
        at = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.add(f'<polyline points="{at}" fill="none" stroke="{line}" stroke-width="{width}"'
                 + (f' stroke-dasharray="{dash}"' if dash else "") + "/>")

    def circle(self, x, y, r, fill="none", line=FAINT, width=1.2, dash=""):
        self.add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r:.1f}" fill="{fill}" stroke="{line}" '
                 f'stroke-width="{width}"' + (f' stroke-dasharray="{dash}"' if dash else "") + "/>")

    def dot(self, x, y, colour=NOTE, r=3.2):
        self.circle(x, y, r, colour, colour)

    def text(self, x, y, words, colour=NOTE, size=14, anchor="middle", bold=False):
        for k, line in enumerate(words.split("\n")):
            self.add(f'<text x="{x:.1f}" y="{y + 1.25 * size * k:.1f}" font-size="{size}" '
                     f'fill="{colour}" text-anchor="{anchor}"'
                     + (' font-weight="bold"' if bold else "") + f">{line}</text>")

    def arrow(self, x0, y0, x1, y1, colour=FORCE, width=2.2, both=False, dash=""):
        length = math.hypot(x1 - x0, y1 - y0)
        ux, uy = (x1 - x0) / length, (y1 - y0) / length
        tip = min(9.0, 0.5 * length)
        ends = [(x1, y1, ux, uy)] + ([(x0, y0, -ux, -uy)] if both else [])
        start = (x0 + ux * tip * 0.8, y0 + uy * tip * 0.8) if both else (x0, y0)
        self.path([start, (x1 - ux * tip * 0.8, y1 - uy * tip * 0.8)], colour, width, dash)
        for x, y, a, b in ends:
            self.polygon([(x, y), (x - tip * a - 0.45 * tip * b, y - tip * b + 0.45 * tip * a),
                          (x - tip * a + 0.45 * tip * b, y - tip * b - 0.45 * tip * a)],
                         colour, colour, 0.5)

    def arc(self, x, y, r, first, last, colour=FORCE, width=2.0):
        """From angle first to last, in degrees anticlockwise from +x as seen."""
        steps = [first + (last - first) * k / 40 for k in range(41)]
        self.path([(x + r * math.cos(math.radians(a)), y - r * math.sin(math.radians(a)))
                   for a in steps], colour, width)

    def svg(self):
        w, h = self.size
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" '
                f'viewBox="0 0 {w} {h}" font-family="DejaVu Sans, Arial, sans-serif">\n'
                f'<rect width="{w}" height="{h}" fill="#ffffff"/>\n')
        return head + "\n".join(self.rows) + "\n</svg>\n"
