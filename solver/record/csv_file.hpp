// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "common/formats/run_data.hpp"

namespace ice {

/// A growing CSV table with a header line; named x.part until finish() renames it.
/// @throws Error (exit code 1) naming the file when the disk is full.
class CsvFile {
public:
    CsvFile(std::filesystem::path path, const std::string& header);
    /// Goes on from the first `bytes` of an earlier file of the same table: `earlier` or
    /// `earlier`.part, which this one may replace. Without them the rows begin here.
    CsvFile(std::filesystem::path path, const std::string& header,
            const std::filesystem::path& earlier, std::int64_t bytes);
    /// True when the earlier rows were not found.
    bool begins_late() const { return begins_late_; }
    /// Writes what is buffered to disk and tells how long the file is [bytes].
    std::int64_t flush();
    void add(const std::vector<double>& row);
    void finish();

private:
    std::filesystem::path path_;
    std::ofstream out_;
    bool begins_late_ = false;
};

/// Columns of forces.csv and floe_<id>.csv (CONTRACT.md, section 5).
extern const char* const kForceColumns;
extern const char* const kFloeColumns;
std::vector<double> csv_row(const HistoryRow& row);
std::vector<double> csv_row(const TrackRow& row);

}  // namespace ice
