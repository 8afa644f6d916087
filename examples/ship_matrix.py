#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""ship_matrix.py FILE --about X Y Z [--centre-of-gravity X Y Z] > ship.toml: added mass and damping
that another program computed, as the file that a case's ship.matrix names.

FILE is the radiation problem of one ship, with the axes of its mesh (x forward, z up): Capytaine's
data set (.nc, variables added_mass and radiation_damping) or WAMIT's numerical output (.1) of added
mass.

--about is the point that the program took moments about, in the axes of the hull's mesh [m].
icesolve moves the matrices to the ship's centre of gravity; name it here, too, if it is another
point and low and high frequencies differ much, as both are moved before they are joined. Surge,
sway and yaw are taken at the frequency --slow (default: the lowest in the file), heave, roll and
pitch at --fast (default: the highest), both in rad/s, the nearest one in the file; what couples the
one with the other is left out. Damping by waves is 0 at both limits: --damping W takes it at W.

Numbers of a .1 are shares of water_density L^k, k = 3 to 5, and of the frequency: --length L [m]
(ULEN of WAMIT) and --density [kg/m3] are needed. A period below 0 in it means the frequency 0, a
period of 0 an infinite one. Debian: python3-numpy; for .nc python3-xarray and python3-h5netcdf or
python3-scipy."""
import argparse
import pathlib
import sys

import numpy

MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
SLOW, FAST = (0, 1, 5), (2, 3, 4)


def fail(text):
    print(f"ship_matrix.py: {text}", file=sys.stderr)
    sys.exit(2)


def read_capytaine(path):
    """Frequencies [rad/s], added mass and damping, each [frequency, 6, 6] in SI units."""
    import xarray
    try:
        data = xarray.open_dataset(path)
    except (OSError, ValueError) as error:
        fail(f"{path}: is no data set that xarray can read ({error})")
    for name in ("added_mass", "radiation_damping"):
        if name not in data:
            fail(f"{path}: has no {name}; it has {', '.join(data.data_vars)}")
    dofs = [str(d) for d in data.radiating_dof.values]
    places = {d.lower(): k for k, d in enumerate(dofs)}
    missing = [m for m in MOTIONS if m not in places]
    if missing:
        fail(f"{path}: has no motion {missing[0]}, only {', '.join(dofs)}; "
             "solve all six of one body")
    order = [dofs[places[m]] for m in MOTIONS]

    def matrix(name):
        one = data[name].squeeze(drop=True)
        extra = set(one.dims) - {"omega", "influenced_dof", "radiating_dof"}
        if extra:
            fail(f"{path}: {name} depends on {', '.join(sorted(extra))}, too; keep one value of it")
        if "omega" not in one.dims:
            one = one.expand_dims("omega")
        one = one.transpose("omega", "influenced_dof", "radiating_dof")
        names = [str(d) for d in data.influenced_dof.values]
        rows = [names.index(d) for d in order]
        columns = [dofs.index(d) for d in order]
        return numpy.asarray(one.values, float)[:, rows][:, :, columns]

    if "omega" not in data.coords:
        fail(f"{path}: has no frequencies 'omega'")
    return numpy.atleast_1d(numpy.asarray(data.omega.values, float)), matrix("added_mass"), matrix(
        "radiation_damping")


def read_wamit(path, length, density):
    """The same of a .1 file."""
    if length is None or density is None:
        fail("--length and --density are needed: a .1 file has shares of density L^k")
    found = {}
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        words = line.replace("D", "E").split()
        try:
            period, i, j = float(words[0]), int(words[1]), int(words[2])
            values = [float(word) for word in words[3:5]]
        except (IndexError, ValueError):
            if found or number > 1:  # the first line may be a title
                fail(f"{path}:{number}: is no row 'period i j added-mass [damping]'")
            continue
        if not values or not (1 <= i <= 6 and 1 <= j <= 6):
            fail(f"{path}:{number}: is no row of one body with six motions")
        omega = 0.0 if period < 0 else numpy.inf if period == 0 else 2 * numpy.pi / period
        added, damping = found.setdefault(omega, (numpy.zeros((6, 6)), numpy.zeros((6, 6))))
        scale = density * length**(3 + (i > 3) + (j > 3))
        added[i - 1, j - 1] = scale * values[0]
        if len(values) > 1 and numpy.isfinite(omega):
            damping[i - 1, j - 1] = scale * omega * values[1]
    if not found:
        fail(f"{path}: holds no rows")
    omegas = sorted(found)
    return (numpy.array(omegas), numpy.array([found[w][0] for w in omegas]),
            numpy.array([found[w][1] for w in omegas]))


def nearest(omegas, wanted):
    if numpy.isinf(wanted):
        return int(numpy.argmax(omegas))
    return int(numpy.argmin(numpy.abs(omegas - wanted)))


def symmetric(matrix):
    return 0.5 * (matrix + matrix.T)


def moved(matrix, arm):
    """M' = T^T M T about a point that lies at `arm` from the old one: v = v' + arm x w."""
    to_old = numpy.eye(6)
    for k in range(3):
        to_old[:3, 3 + k] = numpy.cross(arm, numpy.eye(3)[k])
    return to_old.T @ matrix @ to_old


def joined(slow, fast, arm):
    """Surge, sway, yaw of the one, heave, roll, pitch of the other, about a point at `arm`."""
    both = [moved(symmetric(m), arm) for m in (slow, fast)]
    out = numpy.zeros((6, 6))
    for matrix, group in zip(both, (SLOW, FAST)):
        out[numpy.ix_(group, group)] = matrix[numpy.ix_(group, group)]
    return out


def table(name, matrix):
    rows = (f"{m} = [{', '.join(repr(float(v)) for v in row)}]\n"
            for m, row in zip(MOTIONS, matrix))
    return f"[{name}]\n{''.join(rows)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=pathlib.Path)
    for name in ("--about", "--centre-of-gravity"):
        parser.add_argument(name, nargs=3, type=float, required=name == "--about",
                            metavar=("X", "Y", "Z"))
    for name in ("--slow", "--fast", "--damping", "--length", "--density"):
        parser.add_argument(name, type=float)
    options = parser.parse_args()
    if not options.file.is_file():
        fail(f"{options.file}: not found")
    if options.file.suffix == ".1":
        omegas, added, damping = read_wamit(options.file, options.length, options.density)
    else:
        omegas, added, damping = read_capytaine(options.file)
    slow = nearest(omegas, omegas.min() if options.slow is None else options.slow)
    fast = nearest(omegas, omegas.max() if options.fast is None else options.fast)
    point = options.centre_of_gravity or options.about
    arm = numpy.subtract(point, options.about)
    water = joined(added[slow], added[fast], arm)
    if not (numpy.isfinite(water).all() and (numpy.diag(water) >= 0.0).all()):
        fail(f"{options.file}: has no added mass of 0 or more at {omegas[slow]:g} and "
             f"{omegas[fast]:g} rad/s; name other frequencies")
    text = (f"# Of {options.file.name}: surge, sway, yaw at {omegas[slow]:g} rad/s, "
            f"heave, roll, pitch at {omegas[fast]:g} rad/s; kg, kg m, kg m2\n"
            f"about = {[float(x) for x in point]}\n" +
            table("added_mass", water))
    if options.damping is not None:
        at = nearest(omegas, options.damping)
        waves = joined(damping[at], damping[at], arm)
        if not numpy.isfinite(waves).all():
            fail(f"{options.file}: has no damping at {omegas[at]:g} rad/s")
        text += f"# by waves of {omegas[at]:g} rad/s; N s/m, N s, N m s\n" + table("damping", waves)
    print(text, end="")


if __name__ == "__main__":
    main()
