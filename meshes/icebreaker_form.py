# SPDX-License-Identifier: GPL-3.0-or-later
"""The icebreaker's form as closed formulas: profiles, half breadths, areas and volumes.

Axes: x forward from the transom, y to port, z up from the calm water line; metres.

Every water line z = const is the midship half breadth times a bow factor and a stern factor:

    Y(x, z) = B(z) f((x_stem(z) - x) / L_bow(z)) g((x - x_run(z)) / L_run(z))
    f(s) = 1 - (1 - s)^2.5 (1 + a s)   g(s) = 1 - (1 - s)^3 (1 + b s)   both 1 for s >= 1

f and g leave the centre line at the slope m = 2.5 - a (or 3 - b) and reach full breadth without a
jump of slope or curvature. The stem and the run are straight lines that a parabola turns into the
flat bottom, so near it every section is horizontal too: the bottom has no knuckle. A section at the
stem flares at tan(flare) = tan(half entrance) / tan(stem angle) from the vertical.

Half breadths need only + - * / and sqrt beyond five tangents: all machines get the same numbers.
"""
import math

LENGTH, DRAUGHT, DEPTH = 100.0, 8.0, 13.0
HALF_BREADTH = 11.0       # at midships on the water line
SIDE_DEG = 3.0            # the side leans outward by this much from the vertical
BILGE_RADIUS = 2.0

STEM_DEG = 24.0           # from the horizontal, straight from the forefoot to 1 m above the water
STEM_RADIUS = 16.0        # radius of curvature where the forefoot leaves the bottom
STEM_BEND_Z = 1.0         # above this the stem steepens ...
STEM_TOP_DEG = 60.0       # ... to this at the deck
ENTRANCE_DEG = 30.0       # half entrance angle of the water line
ENTRANCE_GROWTH = 0.02    # per m2: above the water m grows by this times z^2: a broad foredeck
SHOULDER_X, SHOULDER_RAKE = 56.0, 0.8   # full breadth ends forward at x = SHOULDER_X + RAKE z

RUN_DEG = 20.0            # of the buttocks, from the horizontal
RUN_START_X = 28.0        # where the bottom begins to rise
TRANSOM_Z = 0.5           # lowest point of the transom
RUN_SLOPE_M = 3.8         # m of g; 3 would be a cubic, 4 the fullest without a bulge
RUN_END_X, RUN_END_RAKE = 32.0, -1.25   # full breadth ends aft at x = RUN_END_X + RAKE z

KEEL, DECK = -DRAUGHT, DEPTH - DRAUGHT
TAN_STEM = math.tan(math.radians(STEM_DEG))
COT_TOP = 1 / math.tan(math.radians(STEM_TOP_DEG))
TAN_ENTRANCE = math.tan(math.radians(ENTRANCE_DEG))
TAN_RUN = math.tan(math.radians(RUN_DEG))
TAN_SIDE = math.tan(math.radians(SIDE_DEG))
COS_SIDE = 1 / math.sqrt(1 + TAN_SIDE * TAN_SIDE)

BILGE_TOP_Z = KEEL + BILGE_RADIUS * (1 - TAN_SIDE * COS_SIDE)  # where the arc touches the side
FLAT_HALF_BREADTH = HALF_BREADTH + TAN_SIDE * (KEEL + BILGE_RADIUS) - BILGE_RADIUS / COS_SIDE
BEND_FALL = (1 / TAN_STEM - COT_TOP) / (2 * (DECK - STEM_BEND_Z))  # of dx/dz above the bend
RUN_RADIUS = 2 * (RUN_START_X / TAN_RUN - (TRANSOM_Z - KEEL) / TAN_RUN ** 2)


# --- profiles in the centre plane ----------------------------------------------------------------

def turned_line(rise, slope, radius):
    """How far a line of this slope is from its turn, at this rise above the bottom."""
    turn = radius * slope * slope / 2   # the parabola rise = x^2 / (2 radius) ends here
    if rise < turn:
        return math.sqrt(2 * radius * max(rise, 0.0))
    return radius * slope + (rise - turn) / slope


def stem_reach(z):
    above = max(z - STEM_BEND_Z, 0.0)
    return turned_line(z - KEEL, TAN_STEM, STEM_RADIUS) - BEND_FALL * above * above


FOREFOOT_X = LENGTH - stem_reach(DECK)


def stem_x(z):
    """x of the stem; at z = KEEL where the flat bottom begins."""
    return FOREFOOT_X + stem_reach(z)


def run_x(z):
    """x where the water line closes aft; beyond the transom, x < 0, for z > TRANSOM_Z."""
    return RUN_START_X - turned_line(z - KEEL, TAN_RUN, RUN_RADIUS)


def keel_z(x):
    """Height of the centre line's lower edge: run, bottom or stem."""
    if RUN_START_X <= x <= FOREFOOT_X:
        return KEEL
    low, high = KEEL, DECK

    def inside(z):  # the profile rises to both ends
        return run_x(z) <= x <= stem_x(z)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if inside(middle) else (middle, high)
    return high


# --- half breadths --------------------------------------------------------------------------------

def midship(z):
    """Half breadth of the parallel midbody: flat bottom, bilge arc, leaning side."""
    if z >= BILGE_TOP_Z:
        return HALF_BREADTH + TAN_SIDE * z
    below = max(min(KEEL + BILGE_RADIUS - z, BILGE_RADIUS), 0.0)
    return FLAT_HALF_BREADTH + math.sqrt(BILGE_RADIUS * BILGE_RADIUS - below * below)


def shoulder_x(z):
    return SHOULDER_X + SHOULDER_RAKE * z


def run_end_x(z):
    return RUN_END_X + RUN_END_RAKE * z


BOW_SLOPE_M = TAN_ENTRANCE * (stem_x(0.0) - shoulder_x(0.0)) / HALF_BREADTH


def bow_slope(z):
    above = max(z, 0.0)
    return BOW_SLOPE_M + ENTRANCE_GROWTH * above * above


def half_breadth(x, z):
    rest = 1 - min(max((stem_x(z) - x) / (stem_x(z) - shoulder_x(z)), 0.0), 1.0)
    bow = 1 - rest * rest * math.sqrt(rest) * (1 + (2.5 - bow_slope(z)) * (1 - rest))
    rest = 1 - min(max((x - run_x(z)) / (run_end_x(z) - run_x(z)), 0.0), 1.0)
    run = 1 - rest * rest * rest * (1 + (3 - RUN_SLOPE_M) * (1 - rest))
    return midship(z) * bow * run


# --- areas and volumes, without a mesh ------------------------------------------------------------

def missing_part(power, extra, rest):
    """Integral of (1 - s)^power (1 + extra s) over s from 1 - rest to 1."""
    return ((1 + extra) * rest ** (power + 1) / (power + 1)
            - extra * rest ** (power + 2) / (power + 2))


def waterline_area(z):
    """Area inside the water line at height z, both sides. Bow and run must not overlap."""
    bow_length, run_length = stem_x(z) - shoulder_x(z), run_end_x(z) - run_x(z)
    aft = max(run_x(z), 0.0)
    rest = (run_end_x(z) - aft) / run_length
    full = stem_x(z) - aft
    missing = (bow_length * missing_part(2.5, 2.5 - bow_slope(z), 1.0)
               + run_length * missing_part(3.0, 3.0 - RUN_SLOPE_M, rest))
    return 2 * midship(z) * (full - missing)


def volume_below(top, steps=20000):
    """Volume of the form from the bottom to z = top: midpoint rule, dense near the bottom."""
    total = 0.0
    for k in range(steps):
        t = (k + 0.5) / steps
        total += waterline_area(KEEL + (top - KEEL) * t * t) * 2 * t / steps
    return total * (top - KEEL)
