// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/seal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/state_hash.hpp"

namespace ice {

namespace {

// Hexadecimal digits of a hash of 64 bits [-], behind the data: another number is another format.
// HDF5 does not read beyond its own end of file, so a sealed file is still one of HDF5.
constexpr std::uintmax_t kLength = 16;

// Hash of the first `length` bytes, 8 at a time, the last ones padded with zeros.
std::string hash_of(const std::filesystem::path& path, std::uintmax_t length) {
    std::ifstream in(path, std::ios::binary);
    StateHash hash;
    // The length first: the padding of the last word cannot be taken for data.
    hash.add(std::uint64_t{length});
    std::array<char, 1 << 16> block;
    while (length > 0 && in) {
        const auto count = std::min<std::uintmax_t>(length, block.size());
        block.fill('\0');
        in.read(block.data(), static_cast<std::streamsize>(count));
        for (std::size_t k = 0; k < count; k += sizeof(std::uint64_t)) {
            std::uint64_t word = 0;
            std::memcpy(&word, block.data() + k, sizeof word);
            hash.add(word);
        }
        length -= count;
    }
    return fmt::format("{:016x}", hash.value());
}

}  // namespace

void add_seal(const std::filesystem::path& path) {
    // Read back from the disk, not hashed while writing: HDF5 writes in an order of its own.
    const std::string seal = hash_of(path, std::filesystem::file_size(path));
    std::ofstream out(path, std::ios::binary | std::ios::app);
    out << seal;
    out.close();
    if (!out)
        throw run_failed(path.string(), "cannot be completed", "check that the disk is not full");
}

bool has_right_seal(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error || size <= kLength) return false;
    std::string seal(kLength, ' ');
    std::ifstream in(path, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(size - kLength));
    in.read(seal.data(), kLength);
    return in && seal == hash_of(path, size - kLength);
}

}  // namespace ice
