// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/paraview/xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "postprocess/views/svg.hpp"

namespace ice::paraview {

namespace {

using views::escape;

// XDMF's words for columns of numbers; a matrix may have any number of them.
const char* kind_of(std::uint64_t columns) {
    return columns == 1 ? "Scalar" : columns == 3 ? "Vector" : "Matrix";
}

std::string grid_text(const std::string& name, const std::string& time, const Grid& grid) {
    // A grid is a surface, with values on its triangles, or a set of points, with values on the
    // points.
    const bool triangles = grid.cells.columns == 3;
    std::string out = fmt::format(
        "<Grid Name=\"{}\" GridType=\"Uniform\">{}\n<Topology TopologyType=\"{}\" "
        "NumberOfElements=\"{}\"{}>{}</Topology>\n<Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
        escape(name), time, triangles ? "Triangle" : "Polyvertex", grid.cells.rows,
        triangles ? "" : " NodesPerElement=\"1\"", grid.cells.item, grid.points.item);
    for (const NamedArray& array : grid.values)
        out += fmt::format(
            "<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
            escape(array.name), kind_of(array.values.columns), triangles ? "Cell" : "Node",
            array.values.item);
    return out + "</Grid>\n";
}

}  // namespace

ArrayFile::ArrayFile(const std::filesystem::path& path)
    : file_name_(path.filename().string()),
      part_(path),
      file_(part_.path(), Hdf5File::Mode::create) {}

void ArrayFile::close() {
    // The name is given when the file is complete: a reader never sees half of the arrays.
    file_.close();
    part_.keep();
}

template <class T>
StoredArray ArrayFile::store(const std::string& name, const std::vector<T>& values,
                             std::uint64_t columns, const char* type) {
    // one chunk as long as the array: it is written once and read as a whole
    const std::uint64_t rows = values.size() / columns;
    file_.create_appendable<T>(
        name, columns == 1 ? std::vector<std::uint64_t>{} : std::vector<std::uint64_t>{columns},
        rows);
    if (rows > 0) file_.append(name, values.data(), rows);
    return {fmt::format("<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"4\" "
                        "Dimensions=\"{}{}\">{}:{}</DataItem>",
                        type, rows, columns == 1 ? "" : fmt::format(" {}", columns),
                        escape(file_name_), name),
            rows, columns};
}

StoredArray ArrayFile::add(const std::string& name, const std::vector<float>& values,
                           std::uint64_t columns) {
    return store(name, values, columns, "Float");
}

StoredArray ArrayFile::add(const std::string& name, const std::vector<std::int32_t>& values,
                           std::uint64_t columns) {
    return store(name, values, columns, "Int");
}

XdmfFile::Part& XdmfFile::part(const std::string& name, bool timed) {
    // Parts stay in the order in which they came first: it is that of ParaView's list of blocks.
    const auto found =
        std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.name == name; });
    if (found != parts_.end()) return *found;
    return parts_.emplace_back(Part{name, "", timed});
}

void XdmfFile::add(const std::string& name, double time, const Grid& grid) {
    if (grid.cells.rows == 0) return;
    part(name, true).grids += grid_text(name, fmt::format("<Time Value=\"{:.9g}\"/>", time), grid);
}

void XdmfFile::add(const std::string& name, const Grid& grid) {
    if (grid.cells.rows > 0) part(name, false).grids += grid_text(name, "", grid);
}

std::string XdmfFile::text() const {
    std::string out = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n";
    for (const Part& p : parts_)
        // A part that does not move is written once, outside the collection in time.
        out += p.timed ? fmt::format(
                             "<Grid Name=\"{}\" GridType=\"Collection\" "
                             "CollectionType=\"Temporal\">\n{}</Grid>\n",
                             escape(p.name), p.grids)
                       : p.grids;
    return out + "</Domain></Xdmf>\n";
}

}  // namespace ice::paraview
