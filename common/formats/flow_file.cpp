// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/flow_file.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/rehearse.hpp"
#include "common/formats/hdf5_file.hpp"
#include "common/formats/refuse_other_format.hpp"
#include "common/formats/sealed_file.hpp"

namespace ice {

namespace {

constexpr const char* kFlowFormat = "icesolve-flow";
// Version of the format; 1 more when an array changes its meaning. A reader refuses all others.
constexpr std::int64_t kFlowVersion = 1;
// Bounds on the memory for a damaged or hostile file. Flows of some 300 000 nodes are usual.
// Most memory over the file's size [-]. Arrays are not compressed, so that 1 would be enough for a
// sound file; 16 leaves room for files packed by other tools. A larger value lets a hostile file
// take more memory, a smaller one refuses files packed well.
constexpr std::uint64_t kMostTimesFlow = 16;
// Most nodes along an axis [-]; the product of three of them fits into 64 bits. A much larger value
// lets it overflow, a smaller one refuses fine tables.
constexpr std::uint64_t kMostAlong = 100000;
// Largest distance of the topmost nodes from z = 0, as a share of the spacing [-]: rounding of
// origin and spacing. Larger would pass a table whose surface is elsewhere; smaller refuses sound
// tables by rounding.
constexpr double kSurface = 1e-6;

class FlowReader {
public:
    explicit FlowReader(const std::filesystem::path& path)
        : path_(path), file_(path, Hdf5File::Mode::read) {
        file_.limit_reading(kMostTimesFlow);
    }

    FlowTable read() const {
        refuse_other_format(path_, file_, kFlowFormat, "a flow");
        check(file_.has_attribute("/", "format") &&
                  file_.read_text_attribute("/", "format") == kFlowFormat,
              "/", "is not a flow (no attribute format = \"icesolve-flow\")");
        check(number("format_version") == kFlowVersion, "/",
              "has a format_version this program does not know");
        refuse_changed(path_, file_, "iceflow");
        FlowTable out;
        // sizes are bounded before anything is read: a damaged file must not take all memory
        const auto shape = file_.shape("/velocity");
        check(shape.size() == 4 && shape[3] == 3, "/velocity", "is not [nz, ny, nx, 3]");
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint64_t n = shape[2 - axis];
            check(n >= (axis == 1 ? 1 : 2) && n <= kMostAlong, "/velocity",
                  "has too few or too many nodes");
            out.nodes[axis] = static_cast<std::int64_t>(n);
        }
        // Single precision, in the units of reference_speed: a step interpolates w / U.
        out.velocity = finite("/velocity", 3 * out.size());
        out.potential = finite("/potential", out.size());
        const auto origin = file_.read_number_attribute("/", "origin");
        check(origin.size() == 3, "origin", "is not three numbers");
        out.origin = Vec3(origin[0], origin[1], origin[2]);
        check(out.origin.allFinite(), "origin", "is no place");
        out.spacing = number("spacing");
        check(out.spacing > 0.0, "spacing", "is not positive");
        // the flow ends at the water's surface, which the solver takes as z = 0
        const double top = out.origin.z() + out.spacing * static_cast<double>(out.nodes[2] - 1);
        check(std::abs(top) <= kSurface * out.spacing, "origin",
              "does not bring the topmost nodes to z = 0");
        read_rest(out);
        return out;
    }

private:
    void check(bool good, const std::string& dataset, const std::string& what) const {
        if (!good)
            throw bad_input(path_.string() + ": " + dataset, what,
                            "make the file again with iceflow");
    }
    double number(const char* name) const {
        check(file_.has_attribute("/", name), name, "is missing");
        const auto values = file_.read_number_attribute("/", name);
        check(values.size() == 1 && std::isfinite(values[0]), name, "is no finite number");
        return values[0];
    }
    std::string text(const char* name) const {
        return file_.has_attribute("/", name) ? file_.read_text_attribute("/", name) : "";
    }
    std::vector<float> finite(const std::string& name, std::size_t size) const {
        auto values = file_.read<float>(name);
        check(values.size() == size, name, "has another size than /velocity");
        check(std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }),
              name, "holds a NaN or infinity");
        return values;
    }
    void read_rest(FlowTable& out) const {
        out.symmetric = number("symmetric") != 0.0;
        // Half a flow is mirrored in y = 0 when it is looked up: its nodes must begin there.
        check(!out.symmetric || std::abs(out.origin.y()) <= kSurface * out.spacing, "origin",
              "of a symmetric flow is not at y = 0");
        out.draught = number("draught");
        out.reference_speed = number("reference_speed");
        check(out.reference_speed > 0.0, "reference_speed", "is not positive");
        out.panels = static_cast<std::int64_t>(number("panels"));
        out.residual = number("residual");
        out.source_sha256 = text("source_sha256");
        out.created_by = text("created_by");
        out.command_line = text("command_line");
    }

    std::filesystem::path path_;
    Hdf5File file_;
};

}  // namespace

void write_flow(const std::filesystem::path& path, const FlowTable& table) {
    write_sealed(path, [&](Hdf5File& file) {
        file.write_attribute("/", "format", std::string(kFlowFormat));
        file.write_attribute("/", "format_version", kFlowVersion);
        file.write_attribute("/", "units", std::string("SI"));
        file.write_attribute("/", "origin", {table.origin.begin(), table.origin.end()}, {3});
        file.write_attribute("/", "spacing", {table.spacing}, {});
        file.write_attribute("/", "draught", {table.draught}, {});
        file.write_attribute("/", "symmetric", std::int64_t{table.symmetric});
        file.write_attribute("/", "source_sha256", table.source_sha256);
        file.write_attribute("/", "panels", table.panels);
        file.write_attribute("/", "residual", {table.residual}, {});
        file.write_attribute("/", "reference_speed", {table.reference_speed}, {});
        file.write_attribute("/", "created_by", table.created_by);
        file.write_attribute("/", "command_line", table.command_line);
        const auto n = [&](std::size_t axis) {
            return static_cast<std::uint64_t>(table.nodes[axis]);
        };
        // x runs fastest, as in VTK's images: index ((iz ny + iy) nx + ix).
        file.write("/velocity", table.velocity.data(), {n(2), n(1), n(0), 3});
        file.write("/potential", table.potential.data(), {n(2), n(1), n(0)});
    });
}

FlowTable read_flow(const std::filesystem::path& path) {
    std::error_code missing;  // FlowReader complains of it
    const auto size = std::filesystem::file_size(path, missing);
    if (!missing) rehearse(path, ReadBounds::for_size(size), [&] { FlowReader(path).read(); });
    return FlowReader(path).read();
}

}  // namespace ice
