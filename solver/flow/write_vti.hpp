// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "common/formats/flow_file.hpp"

namespace ice {

/// A table as VTK image data (.vti), for ParaView: arrays "velocity" (3 per node, per ship speed)
/// and "potential" (1 per node, per ship speed [m]) on the nodes, both sides of a symmetric one, as
/// raw bytes in the computer's order.
/// @throws Error (exit code 1) when the file cannot be written; nothing half-written stays behind
void write_vti(const std::filesystem::path& file, const FlowTable& table);

}  // namespace ice
