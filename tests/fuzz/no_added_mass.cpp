// SPDX-License-Identifier: GPL-3.0-or-later
// Takes the place of solver/scene/set_added_mass.cpp in targets whose floes move no water: it
// needs the flow's panels, which take long to compile.
#include "solver/scene/set_added_mass.hpp"
#include "tests/fuzz/input_folder.hpp"

namespace ice {

void add_water(Scene&, std::size_t, double) { fuzz::report_finding("floes move water here"); }

}  // namespace ice
