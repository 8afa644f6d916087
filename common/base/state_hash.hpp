// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

namespace ice {

/// Hash of a sequence of doubles, bit by bit: equal states give equal hashes on every machine.
///
/// FNV-1a over 64-bit words with a final mix; -0.0 and 0.0 differ on purpose.
class StateHash {
public:
    /// The order of calls is part of the hash.
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(std::uint64_t word) {
        value_ = (value_ ^ word) * 0x100000001b3ull;
        value_ ^= value_ >> 32;
    }
    /// Hash of all words so far; the offset basis of FNV without any.
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325ull;
};

}  // namespace ice
