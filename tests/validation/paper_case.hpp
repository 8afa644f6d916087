// SPDX-License-Identifier: GPL-3.0-or-later
/// The repository's own cases and meshes as worlds, without the programs in between.
#pragma once

#include "preprocess/fill/fill_spheres.hpp"
#include "solver/step/step.hpp"

namespace ice::test {

/// Sphere set of meshes/<name>.obj.
SphereSet set_of_mesh(const std::string& name, const FillOptions& options);

/// The same of its section y = 0: discs, per metre of breadth.
SphereSet set_of_section(const std::string& name, const FillOptions& options);

/// Sphere set of the prism of 1 m breadth over that section.
SphereSet set_of_prism(const std::string& name, const FillOptions& options);

/// cases/<name> with its hull and floes replaced by these sets, and the overrides of
/// `icesolve --set`.
World world_of_case(const std::string& name, const SphereSet& hull, const SphereSet& floe,
                    std::vector<std::string> overrides = {});

/// The paper's 2D and 3D cases with the sets of their spheres.txt.
World paper_2d(const std::vector<std::string>& overrides = {});
World paper_3d(const std::vector<std::string>& overrides = {});

}  // namespace ice::test
