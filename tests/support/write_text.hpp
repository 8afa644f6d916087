// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "preprocess/write/sink.hpp"

namespace ice::test {

/// What write(sink) writes, as one string.
template <class Write>
std::string text_of(const Write& write) {
    std::string text;
    write([&](std::string_view bytes) { text += bytes; });
    return text;
}

}  // namespace ice::test
