// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/input_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "common/base/error.hpp"

namespace ice {

namespace {

constexpr std::uintmax_t kLargestInput = 64u << 20;  // 64 MB: a million lines fit many times

}  // namespace

std::string read_input_text(const std::filesystem::path& file, const std::string& what) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        throw bad_input(file.string(), what + " not found", "check the path");
    if (std::filesystem::file_size(file, error) > kLargestInput)
        throw bad_input(file.string(), "is too large for a " + what + " (64 MB)",
                        "is this the right file?");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw bad_input(file.string(), "cannot be read", "check its permissions");
    return {std::istreambuf_iterator<char>(in), {}};
}

void throw_mistakes(const Mistakes& mistakes, const std::filesystem::path& file,
                    const std::string& remedy) {
    const std::size_t count = mistakes.texts.size() + mistakes.more;
    if (count == 0) return;
    std::string all = fmt::format("{} mistake{}", count, count == 1 ? "" : "s");
    for (const std::string& text : mistakes.texts) all += "\n" + text;
    if (mistakes.more > 0) all += fmt::format("\nand {} more", mistakes.more);
    throw bad_input(file.string(), all, remedy);
}

}  // namespace ice
