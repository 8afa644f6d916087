// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/formats/run_data.hpp"

namespace ice {

/// A growing CSV table with a header line; named x.part until finish() renames it.
///
/// In 2D forces and energies are per metre of breadth: columns that end in _N or _J are repeated
/// behind the others, with _per_m at the end of their names.
///
/// Rows that a full disk does not take wait in memory: only flush() and finish() fail for them, and
/// may be tried again when there is room.
/// @throws Error (exit code 1) naming the file when it cannot be created or the disk is full.
class CsvFile {
public:
    /// @param columns  names with commas between @param dimension  2 or 3
    CsvFile(std::filesystem::path path, const std::string& columns, int dimension);
    /// Goes on from the first `bytes` of an earlier file of the same table: `earlier` or
    /// `earlier`.part, which this one may replace. Without them the rows begin here.
    CsvFile(std::filesystem::path path, const std::string& columns, int dimension,
            const std::filesystem::path& earlier, std::int64_t bytes);
    /// True when the earlier rows were not found.
    bool begins_late() const { return begins_late_; }
    /// Writes buffered rows to disk and returns the file's length [bytes].
    std::int64_t flush();
    /// @param row  a value for each of `columns`, in the unit of its name; the copies per metre are
    ///             added here
    void add(const std::vector<double>& row);
    /// Writes the last rows and renames the file: no add() afterwards.
    void finish();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void open(const char* mode);
    bool write_waiting();
    // Adds the columns per metre to a header.
    std::string whole_header(const std::string& columns, int dimension);

    std::filesystem::path path_;
    std::vector<std::size_t> per_metre_;     // columns that are repeated at the end
    std::unique_ptr<std::FILE, Close> out_;  // without a buffer of its own
    std::string waiting_;                    // rows that are not on disk yet
    std::int64_t bytes_ = 0;                 // on disk
    bool begins_late_ = false;
};

/// Columns of forces.csv and floe_<id>.csv (docs/contract.md, section 5); kBreakingColumn is one of
/// forces.csv where floes are held until they bend.
extern const char* const kForceColumns;
extern const char* const kBreakingColumn;
extern const char* const kShipColumns;  ///< behind them, of a free ship
extern const char* const kFloeColumns;
/// @param breaking  with kBreakingColumn @param ship  with kShipColumns
std::vector<double> csv_row(const HistoryRow& row, bool breaking, bool ship);
std::vector<double> csv_row(const TrackRow& row);

}  // namespace ice
