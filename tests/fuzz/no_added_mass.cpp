// SPDX-License-Identifier: GPL-3.0-or-later
// Takes the place of solver/scene/added_mass_of_floes.cpp in targets whose floes move no water: it
// needs the flow's panels, which take long to compile.
#include "solver/scene/added_mass_of_floes.hpp"
#include "tests/fuzz/input_folder.hpp"

namespace ice {

void add_water(Scene&, std::size_t, double) { fuzz::report_finding("floes move water here"); }

}  // namespace ice
