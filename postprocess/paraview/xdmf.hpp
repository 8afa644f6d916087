// SPDX-License-Identifier: GPL-3.0-or-later
/// A set of grids over time: an XDMF text that names the arrays of an HDF5 file beside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/part_file.hpp"
#include "common/formats/hdf5_file.hpp"

namespace ice::paraview {

/// An array of the HDF5 file, as XDMF names it.
struct StoredArray {
    std::string item;           ///< the DataItem element
    std::uint64_t rows = 0;     ///< count; 0: no data
    std::uint64_t columns = 1;  ///< numbers in a row
};

/// The HDF5 file; arrays are written once and may serve many grids. Without close() it leaves
/// nothing.
class ArrayFile {
public:
    /// @throws Error (exit code 1) naming the path
    explicit ArrayFile(const std::filesystem::path& path);

    void begin_group(const std::string& name) { file_.create_group(name); }
    /// Stores an array [values / columns x columns] in the file's own types, 4 bytes a number. The
    /// group of its path must exist (begin_group()). Empty values are an array of 0 rows.
    /// @param name  its path in the file @param columns  numbers in a row
    StoredArray add(const std::string& name, const std::vector<float>& values,
                    std::uint64_t columns = 1);
    StoredArray add(const std::string& name, const std::vector<std::int32_t>& values,
                    std::uint64_t columns = 1);
    /// @throws Error (exit code 1) naming the path
    void close();

private:
    template <class T>
    StoredArray store(const std::string& name, const std::vector<T>& values, std::uint64_t columns,
                      const char* type);

    std::string file_name_;
    PartFile part_;
    Hdf5File file_;
};

/// Values with the name under which ParaView lists them; a unit is part of the name.
struct NamedArray {
    std::string name;
    StoredArray values;
};

/// Points with triangles between them, or a vertex per point.
struct Grid {
    StoredArray points;              ///< 3 columns [m]
    StoredArray cells;               ///< points of each triangle, 3 columns; of each vertex, 1
    std::vector<NamedArray> values;  ///< a row per triangle, or per point
};

/// Parts of a scene, each a grid at some of the times. A part's name is its block's in ParaView.
class XdmfFile {
public:
    /// Adds a grid at a time [s], times rising for each part. A grid without cells is left out:
    /// readers refuse it. The part is not there at that time.
    void add(const std::string& name, double time, const Grid& grid);
    /// Adds a grid without a time.
    void add(const std::string& name, const Grid& grid);
    std::string text() const;

private:
    struct Part {
        std::string name, grids;
        bool timed;
    };
    Part& part(const std::string& name, bool timed);
    std::vector<Part> parts_;
};

}  // namespace ice::paraview
