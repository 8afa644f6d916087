// SPDX-License-Identifier: GPL-3.0-or-later
/// Another ice field of the same specification, for a member of an ensemble.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace ice {

/// The field files of a case, made anew with the seeds of an ensemble: icefield is run with the
/// specification in each field file.
///
/// A file is kept, for all members alike, if it contains no specification, if icefield cannot make
/// it again (e.g. polygons whose file lies elsewhere; a warning names it), and if the seed changes
/// nothing, as in brick patterns: two seeds are tried.
class MemberFields {
public:
    /// @param first   seed of the first member; it and the next one are tried
    /// @param folder  for the specifications and the new files; created when needed
    MemberFields(const Case& parameters, std::int64_t first, const std::filesystem::path& folder);

    /// Makes the fields of one member.
    /// @return overrides of the case, "floes.1.file=/path"; none where no field changes with the
    ///         seed, or after an interrupt
    /// @throws Error (exit code 1) when icefield fails with this seed
    std::vector<std::string> overrides(std::int64_t seed);

private:
    struct Group {
        std::size_t number = 0;            ///< in the case, from 1 on
        std::filesystem::path file, stem;  ///< of the case; of the new files
        std::string specification;
    };
    std::filesystem::path file_of(const Group& group, std::int64_t seed) const;
    int make(const Group& group, std::int64_t seed);
    bool changes_with_seed(const Group& group, std::int64_t first);

    std::vector<Group> groups_;             ///< that change with the seed
    std::set<std::filesystem::path> made_;  ///< by this object
};

}  // namespace ice
