// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/output_files.hpp"

#include "common/base/error.hpp"

namespace ice {

namespace fs = std::filesystem;

void OutputFiles::protect(const fs::path& input, const std::string& name) {
    // Canonical: "a.h5" and "./a.h5" are one file. Weakly: an output need not exist yet.
    taken_.emplace(fs::weakly_canonical(input), name);
}

void OutputFiles::add(const std::string& option, const fs::path& file) {
    if (file.empty()) return;
    const fs::path folder = file.parent_path();
    if (!folder.empty() && !fs::is_directory(folder))
        throw run_failed(option, "cannot write " + file.string() + ": no folder " + folder.string(),
                         "make the folder, or write to another one");
    const auto [other, fresh] = taken_.try_emplace(fs::weakly_canonical(file), option);
    if (!fresh)
        throw bad_input(option, "would overwrite " + other->second + ", " + file.string(),
                        "give another name");
}

}  // namespace ice
