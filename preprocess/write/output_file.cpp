// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/write/output_file.hpp"

#include "common/base/error.hpp"

namespace ice {

OutputFile::OutputFile(const std::filesystem::path& path)
    : path_(path), part_(path), out_(part_.path(), std::ios::binary) {}

void OutputFile::write(std::string_view bytes) {
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void OutputFile::close() {
    out_.close();
    if (!out_)
        throw run_failed(path_.string(), "cannot be written",
                         "check that the folder exists, is writable and the disk is not full");
}

}  // namespace ice
