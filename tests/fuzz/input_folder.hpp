// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace ice::fuzz {

/// A folder of this process, in memory where the machine has /dev/shm, for the readers' inputs.
/// Removed at the end of a run without a finding.
class InputFolder {
public:
    InputFolder();
    ~InputFolder();
    InputFolder(const InputFolder&) = delete;
    InputFolder& operator=(const InputFolder&) = delete;

    /// Writes a file of that name and gives its path.
    std::filesystem::path write(const std::string& name, std::string_view bytes) const;

private:
    int owner_;  // process
    std::filesystem::path path_;
};

/// An input's parts: what stands before, between and behind its first `most` - 1 zero bytes.
/// Parts that it lacks are empty.
template <std::size_t most>
std::array<std::string_view, most> split(const std::uint8_t* data, std::size_t size) {
    std::array<std::string_view, most> parts;
    std::string_view rest(reinterpret_cast<const char*>(data), size);
    for (std::size_t k = 0; k + 1 < most; ++k) {
        parts[k] = rest.substr(0, rest.find('\0'));
        rest.remove_prefix(std::min(rest.size(), parts[k].size() + 1));
    }
    parts[most - 1] = rest;
    return parts;
}

/// Ends the program with a message, which is a finding.
[[noreturn]] void report_finding(std::string_view what);

}  // namespace ice::fuzz
