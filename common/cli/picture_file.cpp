// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/picture_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"
#include "common/cli/sibling_program.hpp"

namespace ice {

namespace {

constexpr const char* kConverter = "rsvg-convert";

// "png" of "a.PNG"
std::string format_of(const std::filesystem::path& file) {
    std::string suffix = file.extension().string();
    if (!suffix.empty()) suffix.erase(0, 1);
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return suffix;
}

bool is_picture(const std::string& format) {
    return format == "svg" || format == "png" || format == "pdf";
}

bool is_on_path(const std::string& program) {
    const char* path = std::getenv("PATH");
    // Without PATH the shell's usual folders; an empty entry is the working folder, as in POSIX.
    std::istringstream folders(path != nullptr ? path : "/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (access(((folder.empty() ? "." : folder) + "/" + program).c_str(), X_OK) == 0)
            return true;
    return false;
}

}  // namespace

void check_picture_name(const std::filesystem::path& file) {
    const std::string format = format_of(file);
    if (!is_picture(format))
        throw bad_input(file.string(), "pictures are written as .svg, .png or .pdf",
                        "give the file one of these suffixes");
    // Asked before the work: a report of minutes must not fail at its last file.
    if (format != "svg" && !is_on_path(kConverter))
        throw bad_input(
            file.string(),
            fmt::format("a .{} is made by {}, which is not installed", format, kConverter),
            "apt-get install librsvg2-bin, or give the file the suffix .svg");
}

void write_picture(const std::filesystem::path& file, const std::string& svg) {
    check_picture_name(file);
    const std::string format = format_of(file);
    if (format == "svg") {
        write_text_file(file, svg);
        return;
    }
    // Through a file beside the picture: run_child() gives a program no input.
    PartFile part(file);
    const PartFile drawing(file.string() + ".svg");  // never kept: removed at the end
    write_text_file(drawing.path(), svg);
    std::vector<std::string> words{"--format=" + format, "--output=" + part.path().string()};
    // twice the pixels, for screens of high density and prints; white, as most programs show no
    // background
    if (format == "png") words.insert(words.end(), {"--zoom=2", "--background-color=white"});
    words.push_back(drawing.path().string());
    if (run_child(kConverter, words) != 0)
        throw run_failed(file.string(), std::string("cannot be written by ") + kConverter,
                         "check that the folder is writable and the disk is not full, or give the "
                         "file the suffix .svg");
    part.keep();
}

void check_page_name(const std::filesystem::path& file) {
    if (is_picture(format_of(file)))
        throw bad_input(file.string(), "this is a page (HTML), not a picture",
                        "give the file the suffix .html");
}

}  // namespace ice
