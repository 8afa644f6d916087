// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "common/formats/run_file.hpp"

namespace ice::paraview {

/// Writes a run for ParaView; open one of the .pvd files:
///
///     run.pvd      hull and floes together
///     floes.pvd    posed surfaces; per triangle body, shape, group, state, contact_force, velocity
///     hull.pvd     the hull where it was; per triangle region
///     bodies.pvd   a point per floe with orientation (w, x, y, z), shape, state and forces, to be
///                  drawn with "3D Glyphs" (orientation mode Quaternion) and shapes.vtm as table
///                  contact_force is that of the ship on the floe [N]
///     frames/      the .vtp files, one per frame and kind
///
/// One file per frame, because readers of VTK 9.2 handle several steps in one file wrongly.
/// @param every keep each `every`th frame, >= 1
/// @return number of frames written
/// @throws Error (exit code 1) naming the file that cannot be written; (2) for a run without frames
std::size_t write_paraview(const RunData& run, const std::filesystem::path& folder,
                           std::size_t every);

}  // namespace ice::paraview
