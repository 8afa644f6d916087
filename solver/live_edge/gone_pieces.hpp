// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/geometry/loop_area.hpp"

namespace ice {

/// A piece that broke off; or a part of the sheet that is gone, which has time and outline alone.
struct IcePiece {
    std::int64_t number;  ///< from 1, in the order of breaking; 0: a part of the sheet
    std::int32_t body;    ///< that it is, or was
    double born, gone;    ///< [s]; gone: inf while it is there
    double load;          ///< downwards, that broke it off [N], 2D [N/m]
    double radius;        ///< of its crack [m]
    Vec2 at;              ///< centre of mass as it broke off, in the ice's axes [m]
    Loop outline;         ///< of the floe, then, in the ice's axes [m]
};

/// Pieces that are no longer in the scene, on the disk: a run of any length keeps in memory those
/// that are.
///
/// They are in a file without a name, which ends with the program.
class GonePieces {
public:
    GonePieces() = default;
    /// A copy has a file of its own. @throws Error (exit code 1) as open(), read() and add()
    GonePieces(const GonePieces& other);
    GonePieces& operator=(const GonePieces& other);
    GonePieces(GonePieces&&) = default;
    GonePieces& operator=(GonePieces&&) = default;
    ~GonePieces() = default;

    bool is_open() const { return file_ != nullptr; }
    /// Bytes of the file; a checkpoint holds as many.
    std::uint64_t bytes() const { return bytes_; }
    /// @throws Error (exit code 1) naming the folder where no file can be created in it
    void open(const std::filesystem::path& folder);

    /// @pre is_open() @throws Error (exit code 1) when the disk is full
    void add(const IcePiece& piece);

    /// Appends all of them to a list, in the order in which they were added.
    /// @throws Error (exit code 1) when they cannot be read
    void read(std::vector<IcePiece>& out) const;

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    [[noreturn]] void fail(const char* what) const;

    std::unique_ptr<std::FILE, Close> file_;
    std::string folder_;
    std::int64_t count_ = 0;
    std::uint64_t bytes_ = 0;
};

}  // namespace ice
