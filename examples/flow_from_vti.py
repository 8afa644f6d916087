#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""flow_from_vti.py FIELD.vti HULL.spheres.h5 --speed U [-o HULL.flow.h5]: a flow from elsewhere.

Takes water velocities that another program computed around the same hull, as VTK image data
(ParaView: filter "Resample To Image", then save as .vti), and writes the table that a case reads
with flow.model = "file". Velocities are divided by the speed U that the field was computed for.

The field's axes are those of the hull's mesh with z = 0 in the water's surface; --aft turns a field
whose ship points to -x. By default velocities are those that the ship sees (far away -U); --frame
earth: those in water at rest far away. Points in the hull (vtkValidPointMask 0) move with the ship.
The table is laid with one spacing along all axes, linear between the field's points; its last two
cells fade to 0, because beyond it the water is at rest. Debian: python3-h5py, python3-numpy."""
import argparse
import base64
import pathlib
import re
import sys
import xml.etree.ElementTree as xml
import zlib

import h5py
import numpy

NUMBERS = {"Float32": "f4", "Float64": "f8", "Int8": "i1", "UInt8": "u1", "Int32": "i4",
           "UInt32": "u4", "Int64": "i8", "UInt64": "u8"}
MOST_NODES = 20_000_000


def fail(text):
    print(f"flow_from_vti.py: {text}", file=sys.stderr)
    sys.exit(2)


class Image:
    """One piece of VTK image data: ascii, base64 or raw, as it is or deflated."""

    def __init__(self, path):
        data = path.read_bytes()
        # raw bytes behind the underscore are no XML: they are cut out before it is parsed
        mark = re.search(rb"<AppendedData[^>]*encoding\s*=\s*[\"'](\w+)[\"'][^>]*>\s*_", data)
        self.appended, self.appended_encoding = b"", ""
        if mark:
            end = data.rfind(b"</AppendedData>")
            self.appended = data[mark.end():end]
            self.appended_encoding = mark.group(1).decode()
            data = data[:mark.start()] + b"</VTKFile>"
        try:
            root = xml.fromstring(data)
        except xml.ParseError as error:
            fail(f"{path}: is no XML ({error}); save it as .vti with ParaView")
        if root.get("type") != "ImageData":
            fail(f"{path}: is no image data; ParaView's filter Resample To Image makes it")
        self.order = ">" if root.get("byte_order") == "BigEndian" else "<"
        self.header = self.order + NUMBERS[root.get("header_type", "UInt32")]
        self.compressor = root.get("compressor", "")
        if self.compressor not in ("", "vtkZLibDataCompressor"):
            fail(f"{path}: is packed with {self.compressor}; save it with compressor None or ZLib")
        image = root.find("ImageData")
        pieces = image.findall("Piece")
        if len(pieces) != 1:
            fail(f"{path}: has {len(pieces)} pieces; save it from one process")
        extent = [int(word) for word in pieces[0].get("Extent").split()]
        self.count = [extent[2 * k + 1] - extent[2 * k] + 1 for k in range(3)]
        spacing = [float(word) for word in image.get("Spacing").split()]
        origin = [float(word) for word in image.get("Origin").split()]
        if min(self.count) < 2 or min(spacing) <= 0:
            fail(f"{path}: is no grid in space")
        self.axes = [origin[k] + spacing[k] * (extent[2 * k] + numpy.arange(self.count[k]))
                     for k in range(3)]
        self.arrays = {array.get("Name"): array
                       for array in pieces[0].findall("PointData/DataArray")}
        self.path = path

    def read(self, name):
        """Array [nz, ny, nx, components] of f64."""
        array = self.arrays[name]
        kind = self.order + NUMBERS[array.get("type")]
        parts = int(array.get("NumberOfComponents", 1))
        how = array.get("format")
        if how == "ascii":
            values = numpy.array(array.text.split(), dtype=float)
        elif how == "binary":
            values = self.unpack(array.text.strip().encode(), "base64", kind)
        else:
            values = self.unpack(self.appended[int(array.get("offset")):], self.appended_encoding,
                                 kind)
        size = self.count[0] * self.count[1] * self.count[2] * parts
        if values.size != size:
            fail(f"{self.path}: {name} has {values.size} numbers, not {size}")
        return values.astype(float).reshape(self.count[2], self.count[1], self.count[0], parts)

    def unpack(self, data, encoding, kind):
        word = numpy.dtype(self.header).itemsize
        coded = encoding == "base64"

        def take(at, size):
            """size bytes from the byte `at`; of base64 from the beginning of a stream of its own"""
            if not coded:
                return data[at:at + size]
            return base64.b64decode(data[at:at + 4 * ((size + 2) // 3)])[:size]

        if not self.compressor:
            size = int(numpy.frombuffer(take(0, word), self.header)[0])
            return numpy.frombuffer(take(0, word + size)[word:], kind)
        blocks = int(numpy.frombuffer(take(0, word), self.header)[0])
        head = (3 + blocks) * word
        sizes = numpy.frombuffer(take(0, head), self.header)[3:]
        begin = 4 * ((head + 2) // 3) if coded else head
        packed = take(begin, int(sizes.sum()))
        out, at = b"", 0
        for size in sizes:
            out += zlib.decompress(packed[at:at + int(size)])
            at += int(size)
        return numpy.frombuffer(out, kind)


def turned(image, field):
    """The field of a ship that points to -x, about the z axis by half a turn."""
    image.axes = [-image.axes[0][::-1], -image.axes[1][::-1], image.axes[2]]
    out = field[:, ::-1, ::-1].copy()
    out[..., :2] *= -1
    return out


def along(old, new, field, axis):
    """Linear between the old places of an axis; the nearest beyond them."""
    at = numpy.clip(numpy.searchsorted(old, new) - 1, 0, len(old) - 2)
    share = numpy.clip((new - old[at]) / (old[at + 1] - old[at]), 0.0, 1.0)
    shape = [1] * field.ndim
    shape[axis] = len(new)
    share = share.reshape(shape)
    return numpy.take(field, at, axis) * (1 - share) + numpy.take(field, at + 1, axis) * share


def fade(count, ends):
    """1 within, 0 at the ends that are asked for, over two cells."""
    from_end = numpy.full(count, numpy.inf)
    if ends[0]:
        from_end = numpy.minimum(from_end, numpy.arange(count))
    if ends[1]:
        from_end = numpy.minimum(from_end, count - 1 - numpy.arange(count))
    s = numpy.clip(from_end / 2.0, 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)


def resample(image, field, spacing, symmetric):
    """(origin, field) on nodes with one spacing; topmost at z = 0, of half a flow first y = 0."""
    x, y, z = image.axes
    if not z[0] < 0.0 or z[-1] < -spacing:
        fail(f"{image.path}: lies from z = {z[0]:g} to {z[-1]:g} m; the water's surface z = 0 "
             "must be in it")
    low_y = 0.0 if symmetric else y[0]
    if symmetric and not y[0] <= spacing:
        fail(f"{image.path}: has no points at y = 0")
    count = [int((x[-1] - x[0]) / spacing + 1e-9) + 1, int((y[-1] - low_y) / spacing + 1e-9) + 1,
             int(-z[0] / spacing + 1e-9) + 1]
    if min(count) < 2 or numpy.prod(count, dtype=float) > MOST_NODES:
        fail(f"--spacing {spacing:g} gives {count} nodes; give another one")
    new_x = x[0] + spacing * numpy.arange(count[0])
    new_y = low_y + spacing * numpy.arange(count[1])
    new_z = spacing * numpy.arange(1 - count[2], 1)
    for axis, (old, new) in enumerate(((z, new_z), (y, new_y), (x, new_x))):
        field = along(old, new, field, axis)
    rim = fade(count[2], (True, False))[:, None, None] * \
        fade(count[1], (not symmetric, True))[None, :, None] * \
        fade(count[0], (True, True))[None, None, :]
    return numpy.array([new_x[0], new_y[0], new_z[0]]), field * rim[..., None]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("field", type=pathlib.Path)
    parser.add_argument("hull", type=pathlib.Path, help="sphere set of the hull, made by spherize")
    parser.add_argument("--speed", type=float, required=True,
                        help="for which the field was computed [m/s]")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="default <hull stem>.flow.h5")
    parser.add_argument("--array",
                        help="name of the velocities (default: the one with 3 components)")
    parser.add_argument("--frame", choices=("ship", "earth"), default="ship")
    parser.add_argument("--aft", action="store_true", help="the field's ship points to -x")
    parser.add_argument("--shift", type=float, nargs=3, default=(0, 0, 0), metavar=("X", "Y", "Z"),
                        help="of the field into the hull's axes [m]")
    parser.add_argument("--draught", type=float, help="water over the hull's lowest point [m]")
    parser.add_argument("--spacing", type=float,
                        help="of the table's nodes [m] (default: the field's least)")
    parser.add_argument("--symmetric", action="store_true", help="keep y >= 0 and mirror it")
    return parser.parse_args()


def velocities(image, options):
    """w / U [nz, ny, nx, 3] in water at rest far away."""
    names = [name for name, array in image.arrays.items() if array.get("NumberOfComponents") == "3"]
    name = options.array or (names[0] if len(names) == 1 else "")
    if name not in names:
        fail(f"{image.path}: has the velocities {', '.join(names) or 'none'}; "
             "name one with --array")
    field = image.read(name)
    inside = None
    if "vtkValidPointMask" in image.arrays:
        inside = image.read("vtkValidPointMask")[..., 0] == 0
    if options.aft:
        field = turned(image, field)
        inside = inside[:, ::-1, ::-1] if inside is not None else None
    image.axes = [axis + shift for axis, shift in zip(image.axes, options.shift)]
    if options.frame == "ship":
        field[..., 0] += options.speed
    if inside is not None:
        field[inside] = (options.speed, 0.0, 0.0)
    if not numpy.isfinite(field).all():
        fail(f"{image.path}: {name} holds a NaN or infinity")
    return field / options.speed


def main():
    options = arguments()
    if not options.speed > 0.0:
        fail("--speed must be above 0")
    for path in (options.field, options.hull):
        if not path.is_file():
            fail(f"{path}: file not found")
    with h5py.File(options.hull) as hull:
        low = float(hull["/mesh/vertices"][:, 2].min())
        sha256 = hull.attrs.get("source_sha256", "")
    image = Image(options.field)
    field = velocities(image, options)
    spacing = options.spacing or float(min(numpy.diff(axis).min() for axis in image.axes))
    origin, field = resample(image, field, spacing, options.symmetric)
    stem = options.hull.name.removesuffix(".h5").removesuffix(".spheres")
    out = options.output or pathlib.Path(stem + ".flow.h5")
    part = out.with_name(out.name + ".part")
    with h5py.File(part, "w") as file:
        file.attrs.update({
            "format": "icesolve-flow", "format_version": 1, "units": "SI", "origin": origin,
            "spacing": spacing, "draught": options.draught or -low,
            "symmetric": int(options.symmetric), "source_sha256": sha256, "panels": 0,
            "residual": 0.0, "reference_speed": options.speed, "created_by": "flow_from_vti.py",
            "command_line": " ".join(sys.argv)})
        file["velocity"] = field.astype("f4")
        file["potential"] = numpy.zeros(field.shape[:3], "f4")  # not known, and not asked for
    part.replace(out)
    count = " x ".join(str(n) for n in field.shape[2::-1])
    print(f"wrote {out}: {count} nodes every {spacing:g} m")


if __name__ == "__main__":
    main()
