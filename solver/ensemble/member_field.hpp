// SPDX-License-Identifier: GPL-3.0-or-later
/// Another ice field of the same specification, for a member of an ensemble.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace ice {

/// Makes the field files of a case anew with another seed: icefield is run with the specification
/// that each field file holds.
///
/// A file is left alone where it holds no specification, where icefield cannot make it again (e.g.
/// polygons whose file lies elsewhere; said as a warning), and where the seed changes nothing, as
/// in brick patterns.
/// @param folder  for the specifications and the new files; created when needed
/// @return overrides of the case, "floes.1.file=/path"; none where no field changes
std::vector<std::string> make_member_fields(const Case& parameters, std::int64_t seed,
                                            const std::filesystem::path& folder);

}  // namespace ice
