// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/part_file.hpp"

#include <fstream>
#include <system_error>

#include "common/base/error.hpp"

namespace ice {

PartFile::PartFile(std::filesystem::path final_path)
    : final_(std::move(final_path)), part_(final_.string() + ".part") {
    std::error_code ignored;
    if (std::filesystem::exists(final_, ignored) &&
        !std::filesystem::is_regular_file(final_, ignored))
        throw run_failed(final_.string(), "exists and is no file: it would be replaced",
                         "give the name of a file");
}

PartFile::~PartFile() {
    if (kept_) return;
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
}

void PartFile::keep() {
    std::error_code error;
    std::filesystem::rename(part_, final_, error);
    if (error)
        throw run_failed(final_.string(), "cannot rename the finished file: " + error.message(),
                         "check that the folder is writable");
    kept_ = true;
}

void write_text_file(const std::filesystem::path& path, const std::string& text) {
    PartFile part(path);
    std::ofstream out(part.path(), std::ios::binary);
    out << text;
    out.close();
    if (!out)
        throw run_failed(path.string(), "cannot be written",
                         "check that the folder exists, is writable and the disk is not full");
    part.keep();
}

}  // namespace ice
