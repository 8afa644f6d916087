// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/input_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "common/base/error.hpp"
#include "common/base/rehearse.hpp"
#include "common/toml/recognise_input.hpp"

namespace ice {

std::string read_input_text(const std::filesystem::path& file, const std::string& what,
                            std::string_view ending, std::uintmax_t largest) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        throw bad_input(file.string(), fmt::format("is a folder, not a {}", what),
                        look_into_folder(file, ending));
    if (!std::filesystem::is_regular_file(file, error))
        throw bad_input(file.string(), what + " not found", "check the path");
    // before it is read: a wrong file may be many gigabytes
    if (std::filesystem::file_size(file, error) > largest)
        throw bad_input(file.string(),
                        fmt::format("is too large for a {} ({} MB)", what, largest >> 20),
                        "is this the right file?");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw bad_input(file.string(), "cannot be read", "check its permissions");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    // a mesh or an HDF5 file would give a syntax error without use
    if (const auto other = recognise_file(file, text))
        throw bad_input(file.string(), fmt::format("is {}, not a {}", other->what, what),
                        other->remedy);
    return text;
}

void rehearse_input(const std::filesystem::path& file, const std::function<void()>& read) {
    std::error_code missing;  // reading complains of it
    const std::uintmax_t size = std::filesystem::file_size(file, missing);
    if (!missing && size <= kLargestInput) rehearse(file, ReadBounds::for_size(size), read);
}

void throw_mistakes(const Mistakes& mistakes, const std::filesystem::path& file,
                    const std::string& remedy) {
    const std::size_t count = mistakes.texts.size() + mistakes.more;
    if (count == 0) return;
    std::string all = fmt::format("{} mistake{}", count, count == 1 ? "" : "s");
    for (const std::string& text : mistakes.texts) all += "\n" + text;
    if (mistakes.more > 0) all += fmt::format("\nand {} more", mistakes.more);
    throw bad_input(file.string(), all, mistakes.remedy.empty() ? remedy : mistakes.remedy);
}

}  // namespace ice
