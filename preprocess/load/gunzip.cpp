// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/gunzip.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <string>

#include "common/base/error.hpp"

namespace ice {

namespace {

struct CloseGzip {
    void operator()(gzFile_s* file) const { gzclose_r(file); }
};

Error damaged(const std::filesystem::path& file, const std::string& how) {
    return bad_input(file.string(), "is no complete gzip file (" + how + ")",
                     "copy or compress it again");
}

}  // namespace

bool is_gzip_name(const std::filesystem::path& file) {
    std::string end = file.extension().string();
    std::transform(end.begin(), end.end(), end.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return end == ".gz";
}

std::string mesh_stem(const std::filesystem::path& file) {
    const std::filesystem::path stem = file.stem();
    return (is_gzip_name(file) ? stem.stem() : stem).string();
}

std::vector<char> gunzip(const std::filesystem::path& file, std::uint64_t limit) {
    const std::unique_ptr<gzFile_s, CloseGzip> in(gzopen(file.c_str(), "rb"));
    if (!in) throw bad_input(file.string(), "cannot be read", "check its permissions");
    // [bytes] read at a time: larger blocks gain no time, smaller ones more calls.
    constexpr std::size_t block = 1 << 20;
    gzbuffer(in.get(), block / 4);
    // a file that does not begin as gzip would be passed on unchanged
    if (gzdirect(in.get()) == 1) throw damaged(file, "it does not begin as one");

    std::vector<char> bytes;
    std::size_t filled = 0;
    for (;;) {
        // Doubled, so that all copies together cost no more than the last one.
        if (bytes.size() - filled < block) bytes.resize(std::max(2 * bytes.size(), 2 * block));
        const int count = gzread(in.get(), bytes.data() + filled, block);
        int code = Z_OK;
        const std::string message = gzerror(in.get(), &code);
        if (count < 0 || (code != Z_OK && code != Z_STREAM_END))
            throw damaged(file, code == Z_BUF_ERROR ? "it ends too early" : message);
        if (count == 0) break;
        filled += static_cast<std::size_t>(count);
        // a small file may unpack to any size
        if (filled > limit)
            throw bad_input(file.string(), fmt::format("unpacks to more than {} bytes", limit),
                            "unpack it yourself, or export a coarser mesh");
    }
    bytes.resize(filled);
    return bytes;
}

}  // namespace ice
