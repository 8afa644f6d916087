// SPDX-License-Identifier: GPL-3.0-or-later
/// Random numbers that are functions of a seed and a number: no order of drawing, hence the same
/// on any thread count (splitmix64: Steele, Lea, Flood, OOPSLA 2014).
#pragma once

#include <cstdint>

namespace ice {

/// The n-th word of a stream: 64 random bits. Any seed and number are allowed; seeds that differ by
/// a multiple of 2^32 give one stream.
inline std::uint64_t random_word(std::uint64_t seed, std::uint64_t n) {
    std::uint64_t z = (seed << 32) + 0x9e3779b97f4a7c15ull * (n + 1);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

/// Uniform in [0, 1) [-], in steps of 2^-53.
inline double random_unit(std::uint64_t seed, std::uint64_t n) {
    return static_cast<double>(random_word(seed, n) >> 11) * 0x1p-53;
}

/// Uniform in [-1, 1) [-], in steps of 2^-52.
inline double random_offset(std::uint64_t seed, std::uint64_t n) {
    return static_cast<double>(random_word(seed, n) >> 11) * 0x1p-52 - 1.0;
}

}  // namespace ice
