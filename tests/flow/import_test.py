#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""import_test.py SOURCE BIN: examples/flow_from_vti.py against iceflow's tables and made-up fields.

Exit code 77 where h5py or numpy is missing."""
import base64
import pathlib
import subprocess
import sys
import tempfile
import zlib

try:
    import h5py
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SOURCE, BIN = (pathlib.Path(word).resolve() for word in sys.argv[1:3])


def check(good, text):
    if not good:
        sys.exit(f"import_test.py: {text}")


def convert(folder, *words, code=0):
    done = subprocess.run([sys.executable, SOURCE / "examples/flow_from_vti.py", *words],
                          cwd=folder, text=True, capture_output=True, check=False)
    check(done.returncode == code, f"exit code {done.returncode} of {words}:\n{done.stderr}")
    return done.stderr


def packed(values, encoding, compressed, word):
    """Bytes of an array as VTK writes them."""
    data = values.tobytes()
    code = base64.b64encode if encoding == "base64" else bytes
    if not compressed:
        return code(numpy.array([len(data)], word).tobytes() + data)
    size = 1000  # several blocks
    blocks = [data[k:k + size] for k in range(0, len(data), size)]
    small = [zlib.compress(block) for block in blocks]
    head = [len(blocks), size, len(data) % size, *(len(block) for block in small)]
    return code(numpy.array(head, word).tobytes()) + code(b"".join(small))


def write_vti(file, field, origin, spacing, *, how="raw", compressed=False, word="<u8", kind="<f4"):
    """field [nz, ny, nx, 3] as image data: ascii, binary (base64 within), raw, base64 (behind)."""
    values = field.astype(kind)
    nz, ny, nx = field.shape[:3]
    extent = f"0 {nx - 1} 0 {ny - 1} 0 {nz - 1}"
    inside, behind = b"", b""
    form, offset = how, ""
    if how == "ascii":
        inside = " ".join(repr(float(v)) for v in values.ravel()).encode()
    elif how == "binary":
        inside = packed(values, "base64", compressed, word)
    else:
        form, offset = "appended", ' offset="0"'
        behind = b'<AppendedData encoding="' + how.encode() + b'">\n_' + packed(
            values, how, compressed, word) + b"</AppendedData>"
    head = (f'<?xml version="1.0"?>\n<VTKFile type="ImageData" byte_order="LittleEndian" '
            f'header_type="{"UInt64" if word == "<u8" else "UInt32"}"'
            f'{" compressor=" + chr(34) + "vtkZLibDataCompressor" + chr(34) if compressed else ""}>'
            f'<ImageData WholeExtent="{extent}" Origin="{" ".join(map(str, origin))}" '
            f'Spacing="{" ".join(map(str, spacing))}"><Piece Extent="{extent}"><PointData>'
            f'<DataArray type="{"Float32" if kind == "<f4" else "Float64"}" Name="U" '
            f'NumberOfComponents="3" format="{form}"{offset}>')
    file.write_bytes(head.encode() + inside + b"</DataArray></PointData></Piece></ImageData>" +
                     behind + b"</VTKFile>")


def table(file):
    with h5py.File(file) as flow:
        return flow["velocity"][:], {name: flow.attrs[name] for name in flow.attrs}


def test_round_trip(folder):
    """iceflow's own export comes back, but for the rim."""
    subprocess.run([BIN / "spherize", SOURCE / "meshes/paper-hull-3d.obj", "-r", "0.2", "--mode",
                    "surface", "-q", "-o", "hull.spheres.h5"], cwd=folder, check=True)
    subprocess.run([BIN / "iceflow", "hull.spheres.h5", "--panel", "0.8", "--spacing", "0.4",
                    "--export", "vti", "-q"], cwd=folder, check=True)
    made, attributes = table(folder / "hull.flow.h5")
    for more in ((), ("--symmetric",)):
        convert(folder, "hull.flow.vti", "hull.spheres.h5", "--speed", "1", "--frame", "earth",
                "--array", "velocity", "-o", "back.flow.h5", *more)
        back, kept = table(folder / "back.flow.h5")
        half = back if more else back[:, back.shape[1] // 2:]
        check(half.shape == made.shape, f"{half.shape} nodes, not {made.shape}")
        inner = (slice(2, None), slice(0, -2), slice(2, -2))
        check(numpy.abs(half[inner] - made[inner]).max() < 1e-6, "the inner nodes differ")
        check(abs(kept["draught"] - attributes["draught"]) < 1e-9, "the draught differs")
        check(kept["source_sha256"] == attributes["source_sha256"], "the hull differs")
    # and a case takes it
    subprocess.run([BIN / "spherize", SOURCE / "meshes/paper-floe-3d.obj", "-r", "0.1", "-s", "0.2",
                    "-q", "-o", "floe.h5"], cwd=folder, check=True)
    (folder / "case.cfg").write_text(
        '[simulation]\nduration = 0.1\n'
        '[hull]\nspheres = "hull.spheres.h5"\nposition = [-9.6, 0, 0]\nspeed = 0.5\n'
        '[flow]\nmodel = "file"\nfile = "back.flow.h5"\n'
        '[[floes]]\nspheres = "floe.h5"\ncount = [1, 1]\n', encoding="utf-8")
    subprocess.run([BIN / "icesolve", "case.cfg", "--check", "-q"], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL)


def test_fields(folder):
    """A linear field in the ship's frame, on cells that are no cubes, in every encoding."""
    shape, origin, spacing, speed = (9, 11, 13), (-6.0, -5.0, -4.0), (1.0, 1.0, 0.5), 2.5
    z, y, x = numpy.meshgrid(*(origin[2 - k] + spacing[2 - k] * numpy.arange(shape[k])
                               for k in range(3)), indexing="ij")
    # w of water at rest
    wake = numpy.stack([0.1 * x + 0.02 * y, 0.03 * z, -0.05 * x + 0.01 * z], -1)
    seen = wake - [speed, 0, 0]
    first = None
    for how in ("ascii", "binary", "raw", "base64"):
        for compressed in (False, True) if how != "ascii" else (False,):
            for word, kind in (("<u8", "<f8"), ("<u4", "<f4")):
                write_vti(folder / "field.vti", seen, origin, spacing, how=how,
                          compressed=compressed, word=word, kind=kind)
                convert(folder, "field.vti", "hull.spheres.h5", "--speed", str(speed),
                        "-o", "f.flow.h5")
                back, kept = table(folder / "f.flow.h5")
                check(back.shape == (9, 21, 25, 3), f"{back.shape} nodes")
                first = back if first is None else first
                check(numpy.abs(back - first).max() < 1e-6, f"{how} {compressed} {kind} differs")
    at = kept["origin"] + kept["spacing"] * numpy.array([7, 9, 5])  # x, y, z of an inner node
    expected = numpy.array([0.1 * at[0] + 0.02 * at[1], 0.03 * at[2],
                            -0.05 * at[0] + 0.01 * at[2]]) / speed
    check(numpy.abs(first[5, 9, 7] - expected).max() < 1e-6,
          "a linear field is not met between its points")
    check(kept["reference_speed"] == speed and kept["panels"] == 0, "attributes")
    check(first[5, 9, 0].any() == 0 and first[0].any() == 0, "the rim does not fade")
    # a ship that points to -x sees the same water
    write_vti(folder / "turned.vti", (seen * [-1, -1, 1])[:, ::-1, ::-1], (-6.0, -5.0, -4.0),
              spacing)
    convert(folder, "turned.vti", "hull.spheres.h5", "--speed", str(speed), "--aft",
            "-o", "t.flow.h5")
    check(numpy.abs(table(folder / "t.flow.h5")[0] - first).max() < 1e-6, "a turned field differs")


def test_refusals(folder):
    before = sorted(folder.iterdir())
    for words, text in ((("none.vti", "hull.spheres.h5", "--speed", "1"), "not found"),
                        (("field.vti", "hull.spheres.h5", "--speed", "0"), "above 0"),
                        (("field.vti", "hull.spheres.h5", "--speed", "1", "--array", "p"),
                         "--array"),
                        (("field.vti", "hull.spheres.h5", "--speed", "1", "--shift", "0", "0", "9"),
                         "must be in it"),
                        (("field.vti", "hull.spheres.h5", "--speed", "1", "--spacing", "1e-4"),
                         "--spacing"),
                        (("case.cfg", "hull.spheres.h5", "--speed", "1"), "no XML")):
        check(text in convert(folder, *words, code=2), f"{words} are not refused with '{text}'")
    check(sorted(folder.iterdir()) == before, "a refused field leaves a file")


with tempfile.TemporaryDirectory() as name:
    work = pathlib.Path(name)
    test_round_trip(work)
    test_fields(work)
    test_refusals(work)
