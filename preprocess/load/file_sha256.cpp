// SPDX-License-Identifier: GPL-3.0-or-later
// The hash of a file's bytes, read block by block with OpenSSL.
#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>

#include "common/base/error.hpp"
#include "preprocess/load/read_mesh.hpp"

namespace ice {

std::string file_sha256(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw bad_input(file.string(), "cannot be read", "check its permissions");
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                          &EVP_MD_CTX_free);
    EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr);
    // Blocks of 64 kB: a mesh of gigabytes needs no more memory than that.
    std::array<char, 1 << 16> block;
    while (in.read(block.data(), block.size()) || in.gcount() > 0)
        EVP_DigestUpdate(context.get(), block.data(), static_cast<std::size_t>(in.gcount()));
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned length = 0;
    EVP_DigestFinal_ex(context.get(), digest.data(), &length);
    std::string hex;
    for (unsigned k = 0; k < length; ++k) hex += fmt::format("{:02x}", digest[k]);
    return hex;
}

}  // namespace ice
