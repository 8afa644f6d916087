// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>

#include "common/formats/run_data.hpp"

namespace ice {

/// A growing CSV table with a header line; named x.part until finish() renames it.
/// @throws Error (exit code 1) naming the file when the disk is full.
class CsvFile {
public:
    CsvFile(std::filesystem::path path, const std::string& header);
    void add(const std::vector<double>& row);
    void finish();

private:
    std::filesystem::path path_;
    std::ofstream out_;
};

/// Columns of forces.csv and floe_<id>.csv (CONTRACT.md, section 5).
extern const char* const kForceColumns;
extern const char* const kFloeColumns;
std::vector<double> csv_row(const HistoryRow& row);
std::vector<double> csv_row(const TrackRow& row);

}  // namespace ice
