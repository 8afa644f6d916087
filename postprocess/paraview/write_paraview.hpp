// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "common/formats/run_file.hpp"

namespace ice::paraview {

/// What to write.
struct ParaviewOptions {
    std::size_t every = 1;     ///< keep each `every`th frame, >= 1
    bool points_only = false;  ///< no surfaces per frame: for long runs of many floes
    double load_from = 0.0;    ///< the load map averages from here on [s]
};

/// Writes a run for ParaView; open one of the .pvd files:
///
///     run.pvd        hull and floes together
///     floes.pvd      posed surfaces; per triangle body, shape, group, state, contact_force and
///                    velocity
///     hull.pvd       the hull where it was; per triangle region
///     bodies.pvd     a point per floe with orientation (w, x, y, z), shape, state and forces, to
///                    be drawn with "3D Glyphs" (orientation mode Quaternion) and shapes.vtm as
///                    table; contact_force is that of the ship on the floe [N]
///     contacts.pvd   a point where a floe pressed on the hull, with floe, sphere of the hull and
///                    the normal_force and friction_force of the floe on the ship [N], means since
///                    the stored frame before: glyphs of type arrow show them
///     hull_load.vtp  the hull in the ship frame; per triangle region and load, the time-averaged
///                    normal load [Pa]
///     frames/        the .vtp files, one per frame and kind
///
/// With points_only there are bodies.pvd, contacts.pvd, hull_load.vtp and shapes.vtm.
/// One file per frame, because readers of VTK 9.2 handle several steps in one file wrongly.
/// @return number of frames written
/// @throws Error (exit code 1) naming the file that cannot be written; (2) for a run without frames
std::size_t write_paraview(const RunData& run, const std::filesystem::path& folder,
                           const ParaviewOptions& options);

}  // namespace ice::paraview
