#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""peer_fields.py > peer_fields.csv: flows around two bodies by other ways than panels.

Bodies at 1 m/s along +x in water without a surface, which is the double body of a ship. Velocities
of the water in the earth frame at places off the body, from

ellipsoid  Lamb, Hydrodynamics, art. 114, exact: with a, b, c = 5, 1, 0.7 and l the positive root of
           sum x_i^2 / (a_i^2 + l) = 1,  phi = -abc / (2 - alpha_0) x int_l^inf ds / ((a^2 + s) D),
           D^2 = product of (a_i^2 + s), alpha_0 = abc times that integral from 0
wigley_k   Michell's thin ship, to first order in breadth over length: sources of -2 df/dx per area
           on the middle plane of y = f = B/2 (1 - (2x/L)^2) (1 - (z/T)^2), L = 10, T = 1; B = 1
           and 0.5

Columns: body, x, y, z [m], u, v, w [m/s]. Needs NumPy.
"""
import numpy as np

AXES = np.array([5.0, 1.0, 0.7])
LENGTH, DRAUGHT = 10.0, 1.0


def gauss(count, low, high):
    x, weight = np.polynomial.legendre.leggauss(count)
    return low + 0.5 * (high - low) * (x + 1.0), 0.5 * (high - low) * weight


def attraction(low):
    """int_low^inf ds / ((a^2 + s) D), by s = low + tan^2 t."""
    t, weight = gauss(400, 0.0, 0.5 * np.pi)
    s = low + np.tan(t) ** 2
    slope = 2.0 * np.tan(t) / np.cos(t) ** 2
    root = np.sqrt(np.prod(AXES[:, None] ** 2 + s, axis=0))
    return np.sum(weight * slope / ((AXES[0] ** 2 + s) * root))


def around_ellipsoid(p):
    low, high = 0.0, float(np.dot(p, p))
    for _ in range(200):  # the sum falls with l
        l = 0.5 * (low + high)
        low, high = (l, high) if np.sum(p ** 2 / (AXES ** 2 + l)) > 1.0 else (low, l)
    along = p / (AXES ** 2 + l)
    slope = 2.0 * along / np.sum(along ** 2)
    root = np.sqrt(np.prod(AXES ** 2 + l))
    size = np.prod(AXES) / (2.0 - np.prod(AXES) * attraction(0.0))
    return -size * (attraction(l) * np.array([1.0, 0.0, 0.0]) -
                    p[0] / ((AXES[0] ** 2 + l) * root) * slope)


def around_thin_ship(p, breadth):
    x, weight_x = gauss(400, -0.5 * LENGTH, 0.5 * LENGTH)
    z, weight_z = gauss(100, -DRAUGHT, DRAUGHT)
    x, z = np.meshgrid(x, z)
    slope = -4.0 * breadth * x / LENGTH ** 2 * (1.0 - (z / DRAUGHT) ** 2)
    source = -2.0 * slope * np.outer(weight_z, weight_x)
    off = np.stack([p[0] - x, np.full_like(x, p[1]), p[2] - z])
    return np.sum(source * off / (4.0 * np.pi * np.sum(off ** 2, axis=0) ** 1.5), axis=(1, 2))


def main():
    dice = np.random.default_rng(7)
    print("body,x,y,z,u,v,w")
    for name, extent in (("ellipsoid", AXES), ("wigley_1", None), ("wigley_0.5", None)):
        for k in range(24):
            if name == "ellipsoid":  # from a tenth of the breadth to a breadth off the surface
                n = dice.normal(size=3)
                at = extent * n / np.linalg.norm(n)
                normal = at / extent ** 2
                p = at + (0.2 + 0.08 * k) * normal / np.linalg.norm(normal)
                p[2] = -abs(p[2])
                w = around_ellipsoid(p)
            else:  # beside the ship, before and behind it
                p = np.array([dice.uniform(-7.0, 7.0), dice.uniform(1.0, 3.0),
                              dice.uniform(-2.0, 0.0)])
                w = around_thin_ship(p, 1.0 if name == "wigley_1" else 0.5)
            print(name + "," + ",".join(f"{v:.9g}" for v in (*p, *w)))


if __name__ == "__main__":
    main()
