// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of run.h5 that are written once: shapes, bodies, labels. Used by run_file.cpp only.
#pragma once

#include <string>
#include <vector>

#include "common/formats/hdf5_file.hpp"
#include "common/formats/run_data.hpp"

namespace ice::run_parts {

/// /shapes/* and /region_names: meshes and spheres of all shapes one after the other; row s of an
/// offset is where shape s begins. All shapes share one list of region names, the hull's first.
void write_shapes(Hdf5File& file, const RunHeader& header);

/// /flow/point and /flow/velocity; nothing for a run without a flow around its hull.
void write_flow_arrows(Hdf5File& file, const RunHeader& header);

/// /frames/body and the bodies' constant data; needs /frames and /xyz.
void write_bodies(Hdf5File& file, const RunHeader& header);

/// A list of texts that labels a dimension.
void write_labels(Hdf5File& file, const std::string& name, const std::vector<std::string>& texts);

/// Labels the dimensions of a dataset, in order.
void attach_scales(Hdf5File& file, const std::string& name, const std::vector<std::string>& scales);

/// Names of the hull's regions; {"hull"} where the mesh has none.
std::vector<std::string> hull_regions(const RunHeader& header);

/// /panels/* and /shapes/hull_panel; needs /hull_regions and /xyz.
void write_panels(Hdf5File& file, const HullPanels& hull, int dimension);

/// Units of the columns of /tracked/<id>. @param force "N" or "N/m"
std::string track_units(const std::string& force);

}  // namespace ice::run_parts
