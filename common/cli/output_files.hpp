// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace ice {

/// The output files of a command line, checked before the work begins.
class OutputFiles {
public:
    /// A file that no output may replace.
    /// @param name  in messages: "the mesh"
    void protect(const std::filesystem::path& input, const std::string& name);

    /// An output; an empty path is none.
    /// @param option  that names it: "--output"
    /// @throws Error naming the option, where the path is a protected file or another output (exit
    ///         code 2), or its folder does not exist (1)
    void add(const std::string& option, const std::filesystem::path& file);

private:
    std::map<std::filesystem::path, std::string> taken_;  // path -> its name in messages
};

}  // namespace ice
