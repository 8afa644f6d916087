// SPDX-License-Identifier: GPL-3.0-or-later
/// A picture of hull and ice at one instant, as SVG.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/formats/run_data.hpp"
#include "postprocess/views/projection.hpp"
#include "postprocess/views/trails.hpp"

namespace ice::views {

struct ViewOptions {
    double width = 560.0;       ///< of the picture [px]; its height follows
    double half_breadth = 0.0;  ///< shown to each side of the centre line [m]; 0: 0.45 ship lengths
    double waterline = 0.0;     ///< height of the calm water in the ship frame [m]
    bool legend = false;        ///< explain the colours below the picture
    std::string hull_id;        ///< draw the hull by reference to define_hull(); empty: in place
};

/// Draws frames of one run from one side. The picture moves with the ship, so the hull is prepared
/// once and is the same in every frame.
///
/// Floes are drawn face by face, the far ones first; hull and floes are ordered by comparing each
/// floe with the hull at its place. Floes outside the picture are left out and, from ahead, those
/// before the stem or aft of midships. Axes are world coordinates. A 2D run (per metre of breadth)
/// is best seen from the side.
class SceneView {
public:
    SceneView(const RunHeader& header, ViewFrom from, const ViewOptions& options);
    SceneView(SceneView&&) noexcept;
    ~SceneView();

    /// Invisible SVG that defines the hull under options.hull_id; put it once into the page.
    std::string define_hull() const;
    /// @param trails drawn up to the frame's time; their floes are numbered and outlined
    /// The picture of a frame, for a run without floes the hull alone.
    std::string draw(const RunFrame& frame, const std::vector<Trail>& trails) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace ice::views
