// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the exports write to, and how they write millions of rows.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>
#include <vector>

#include "common/base/parallel.hpp"
#include "common/formats/sphere_set.hpp"

namespace ice {

/// Takes the next bytes of a file, or of a string in tests.
using Sink = std::function<void(std::string_view)>;

/// Writes rows 0 to count - 1; row(out, k) appends the text or bytes of row k to a
/// fmt::memory_buffer.
///
/// Threads fill blocks of rows, which are written in order: the bytes do not depend on the number
/// of threads. Memory is bounded by 32 blocks of 16 384 rows. row must not throw.
template <class Row>
void write_rows(const Sink& sink, std::size_t count, const Row& row) {
    // Rows of a block and blocks in memory [-]: about 1 MB of text each. They bound the memory and
    // give each thread a long piece of work; the bytes do not depend on them.
    constexpr std::size_t kRows = 16384, kBlocks = 32;
    std::vector<fmt::memory_buffer> blocks(std::min(kBlocks, (count + kRows - 1) / kRows));
    for (std::size_t first = 0; first < count; first += kRows * kBlocks) {
        const std::size_t left = count - first;
        const std::size_t used = std::min(kBlocks, (left + kRows - 1) / kRows);
        parallel_for(used, 2, [&](std::size_t b) {
            const std::size_t begin = first + b * kRows;
            const std::size_t end = std::min(begin + kRows, count);
            blocks[b].clear();
            for (std::size_t k = begin; k < end; ++k) row(blocks[b], k);
        });
        for (std::size_t b = 0; b < used; ++b)
            sink(std::string_view(blocks[b].data(), blocks[b].size()));
    }
}

}  // namespace ice
