// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/formats/pieces_file.hpp"
#include "solver/live_edge/live_edge.hpp"

namespace ice {

/// The content of pieces.h5: all pieces up to now, and the sheet that is left.
PiecesFile record_edge(const LiveEdge& edge);

}  // namespace ice
