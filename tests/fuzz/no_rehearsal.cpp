// SPDX-License-Identifier: GPL-3.0-or-later
// Takes the place of common/base/rehearse.cpp in targets whose library needs no child process at
// the lengths tried here: without one the fuzzer tries ten times as many inputs.
#include "common/base/rehearse.hpp"

namespace ice {

ReadBounds ReadBounds::for_size(std::uint64_t) { return {}; }

std::string read_in_child(const std::filesystem::path&, const ReadBounds&,
                          const std::function<std::string()>& read) {
    return read();
}

void rehearse(const std::filesystem::path&, const ReadBounds&, const std::function<void()>&) {}

}  // namespace ice
