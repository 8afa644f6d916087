// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/pieces_file.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"
#include "common/formats/flatten.hpp"
#include "common/formats/run_arrays.hpp"
#include "common/geometry/mass_properties.hpp"

namespace ice {

namespace {

void write_piece_rows(Hdf5File& file, const std::string& group, const std::vector<PieceRow>& rows) {
    // meshes one after the other, with the rows at which each begins
    std::vector<std::int64_t> vertex_offset{0}, triangle_offset{0};
    std::vector<Vec3> vertices, at;
    std::vector<std::int32_t> triangles;
    std::vector<double> mass;
    for (const PieceRow& row : rows) {
        vertices.insert(vertices.end(), row.mesh.vertices.begin(), row.mesh.vertices.end());
        for (const auto& t : row.mesh.triangles)
            triangles.insert(triangles.end(), t.begin(), t.end());
        vertex_offset.push_back(static_cast<std::int64_t>(vertices.size()));
        triangle_offset.push_back(static_cast<std::int64_t>(triangles.size() / 3));
        at.push_back(row.at);
        mass.push_back(row.mass);
    }
    file.create_group(group);
    file.write(group + "/vertex_offset", vertex_offset);
    file.write(group + "/vertices", flatten<double>(vertices).data(), {vertices.size(), 3});
    file.write(group + "/triangle_offset", triangle_offset);
    file.write(group + "/triangles", triangles.data(), {triangles.size() / 3, 3});
    file.write(group + "/at", flatten<double>(at).data(), {at.size(), 3});
    file.write(group + "/mass", mass);
}

template <class T>
void write_piece_column(Hdf5File& file, const std::string& name, const std::vector<PieceRow>& rows,
                        T PieceRow::*member) {
    std::vector<T> values;
    for (const PieceRow& row : rows) values.push_back(row.*member);
    file.write(name, values);
}

// Reads pieces.h5; each array is checked against the number of pieces before it is used.
class PiecesReader : RunArrays {
public:
    explicit PiecesReader(const std::filesystem::path& path) : RunArrays(path) {}

    PiecesFile read() const {
        check(file().has_attribute("/", "format") &&
                  file().read_text_attribute("/", "format") == "icesolve-pieces",
              "/", "holds no pieces of level ice (no attribute format = \"icesolve-pieces\")");
        check(number("format_version") == 1, "/",
              "has a format_version this program does not know");
        PiecesFile out;
        out.first_body = number("first_body");
        out.piece_group = number("piece_group");
        out.rest_group = number("rest_group");
        out.drift = points("/drift", {1})[0];
        out.pieces = read_piece_rows("/pieces");
        out.rest = read_piece_rows("/rest");
        if (file().has("/sheet")) {
            out.sheet = read_piece_rows("/sheet");
            read_column("/sheet/gone", out.sheet, &PieceRow::gone);
        }
        read_column("/pieces/number", out.pieces, &PieceRow::number);
        read_column("/pieces/body", out.pieces, &PieceRow::body);
        read_column("/pieces/born", out.pieces, &PieceRow::born);
        read_column("/pieces/gone", out.pieces, &PieceRow::gone);
        read_column("/pieces/load", out.pieces, &PieceRow::load);
        read_column("/pieces/radius", out.pieces, &PieceRow::radius);
        for (const PieceRow& row : out.pieces)
            // Bodies below first_body are the ship and floes of the case, whose poses nobody may
            // replace.
            check(row.body >= out.first_body, "/pieces/body", "names a body that is no slot");
        return out;
    }

private:
    std::int32_t number(const char* name) const {
        return static_cast<std::int32_t>(file().read_number_attribute("/", name).at(0));
    }

    template <class T>
    void read_column(const std::string& name, std::vector<PieceRow>& rows,
                     T PieceRow::*member) const {
        const auto values = read_as<T>(name, {rows.size()});
        for (std::size_t k = 0; k < rows.size(); ++k) rows[k].*member = values[k];
    }

    std::vector<PieceRow> read_piece_rows(const std::string& group) const {
        const auto mass = file().read<double>(group + "/mass");
        std::vector<PieceRow> rows(mass.size());
        const auto at = points(group + "/at", {rows.size()});
        const std::uint64_t corners = rows_of(group + "/vertices"),
                            sides = rows_of(group + "/triangles");
        const auto vertices = points(group + "/vertices", {corners});
        const auto triangles = read_as<std::int32_t>(group + "/triangles", {sides, 3});
        // offsets are checked before they index anything
        const auto first = offsets(group + "/vertex_offset", rows.size(), corners);
        const auto side = offsets(group + "/triangle_offset", rows.size(), sides);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            PieceRow& row = rows[k];
            row.mass = mass[k];
            row.at = at[k];
            row.mesh.vertices.assign(vertices.begin() + first[k], vertices.begin() + first[k + 1]);
            // triangles number the vertices of their own piece
            const auto count = static_cast<std::int32_t>(row.mesh.vertices.size());
            for (auto t = static_cast<std::size_t>(side[k]);
                 t < static_cast<std::size_t>(side[k + 1]); ++t) {
                const auto* corner = triangles.data() + 3 * t;
                row.mesh.triangles.push_back({corner[0], corner[1], corner[2]});
                for (const std::int32_t v : row.mesh.triangles.back())
                    check(v >= 0 && v < count, group + "/triangles", "points outside the vertices");
            }
        }
        return rows;
    }
};

void add_floe(RunHeader& header, const PieceRow& row, std::int32_t group, double born) {
    RunShape shape{row.mesh, {}, {}};
    const auto& names = header.shapes[0].mesh.region_names;
    // Pieces have the region "ice" of the hull's list if it is there: the list is one for all
    // shapes of a run.
    const auto ice = std::find(names.begin(), names.end(), "ice");
    shape.mesh.region_names = names;
    shape.mesh.region.assign(
        row.mesh.triangles.size(),
        ice == names.end() ? 0 : static_cast<std::int32_t>(ice - names.begin()));
    const MassProperties solid = measure_mass(row.mesh);
    header.body_shape.push_back(static_cast<std::int32_t>(header.shapes.size()));
    header.body_group.push_back(group);
    header.body_mass.push_back(row.mass);
    // mass / volume is the ice's density: the mesh's moments are those of its volume
    header.body_inertia.push_back(row.mass / solid.volume * solid.inertia.diagonal());
    header.body_born.push_back(born);
    header.body_breaking_load.push_back(row.load);
    header.shapes.push_back(std::move(shape));
}

// Members of a frame, of floes one after the other.
struct Floes {
    RunFrame& frame;

    // The floes of the case stay. The slots behind them, whose bodies change from frame to frame,
    // are replaced by the pieces: each piece is one body for the whole run.
    void keep(std::size_t count) {
        for (auto* list :
             {&frame.position, &frame.velocity, &frame.angular_velocity, &frame.contact_force})
            list->resize(count);
        frame.orientation.resize(count, Eigen::Quaterniond::Identity());
        frame.state.resize(count);
    }
    void add(const RunFrame& from, std::size_t k) {
        frame.position.push_back(from.position[k]);
        frame.orientation.push_back(from.orientation[k]);
        frame.velocity.push_back(from.velocity[k]);
        frame.angular_velocity.push_back(from.angular_velocity[k]);
        frame.contact_force.push_back(from.contact_force[k]);
        frame.state.push_back(from.state[k]);
    }
    // as it drifts, untouched
    void add_drifting(const Vec3& at, const Eigen::Quaterniond& orientation, FloeState state,
                      const Vec3& drift) {
        frame.position.push_back(at);
        frame.orientation.push_back(orientation);
        frame.velocity.push_back(drift);
        for (auto* list : {&frame.angular_velocity, &frame.contact_force})
            list->push_back(Vec3::Zero());
        frame.state.push_back(state);
    }
};

// The piece that a slot's body is at a time; -1: a tile.
std::ptrdiff_t piece_of(const PiecesFile& file, std::int32_t body, double time) {
    for (std::size_t k = 0; k < file.pieces.size(); ++k) {
        const PieceRow& row = file.pieces[k];
        // born at the end of one step and there from the next on
        if (row.body == body && row.born < time && time <= row.gone)
            return static_cast<std::ptrdiff_t>(k);
    }
    return -1;
}

void show_in_frame(const PiecesFile& file, std::size_t others, const RunFrame* before,
                   RunFrame& frame) {
    RunFrame slots = frame;
    Floes floes{frame};
    floes.keep(others);
    // the sheet drifts as a whole, without turning
    const auto add_in_sheet = [&](const PieceRow& row, FloeState state) {
        floes.add_drifting(row.at + frame.time * file.drift, Eigen::Quaterniond::Identity(), state,
                           file.drift);
    };
    for (std::size_t k = 0; k < file.pieces.size(); ++k) {
        const PieceRow& row = file.pieces[k];
        // The order of the file: a piece's index in the frame is the same at all times.
        // Three times of a piece: a part of the sheet, a body of its own in a slot, and gone
        // astern, where it is drawn as it drifts on from its last pose.
        if (frame.time <= row.born)
            add_in_sheet(row, file.sheet.empty() ? FloeState::held : FloeState::absent);
        else if (frame.time <= row.gone)
            floes.add(slots, static_cast<std::size_t>(row.body) - 1);
        else if (before != nullptr)
            floes.add_drifting(
                before->position[others + k] + (frame.time - before->time) * file.drift,
                before->orientation[others + k], FloeState::behind, file.drift);
        else
            add_in_sheet(row, FloeState::behind);
    }
    for (const PieceRow& row : file.rest) add_in_sheet(row, FloeState::held);
    for (const PieceRow& row : file.sheet)
        add_in_sheet(row, frame.time <= row.gone ? FloeState::held : FloeState::absent);
    // contacts name slots; readers want the pieces
    for (HullContact& contact : frame.hull_contacts) {
        if (contact.floe < file.first_body) continue;
        const std::ptrdiff_t piece = piece_of(file, contact.floe, frame.time);
        const std::size_t floe =
            others + (piece < 0 ? file.pieces.size() : static_cast<std::size_t>(piece));
        contact.floe = static_cast<std::int32_t>(floe) + 1;
    }
    // of a sheet that is all gone
    if (file.rest.empty())
        std::erase_if(frame.hull_contacts, [&](const HullContact& c) {
            return static_cast<std::size_t>(c.floe) > others + file.pieces.size();
        });
    // Numbers have changed, and readers rely on the order by floe and sphere.
    std::stable_sort(frame.hull_contacts.begin(), frame.hull_contacts.end(),
                     [](const HullContact& l, const HullContact& r) {
                         return std::pair(l.floe, l.sphere) < std::pair(r.floe, r.sphere);
                     });
}

}  // namespace

void write_pieces(const std::filesystem::path& path, const PiecesFile& pieces) {
    // Under another name until it is complete: a reader never sees half of the pieces.
    const std::filesystem::path part = path.string() + ".part";
    {
        Hdf5File file(part, Hdf5File::Mode::create);
        file.write_attribute("/", "format", std::string("icesolve-pieces"));
        file.write_attribute("/", "format_version", std::int64_t{1});
        file.write_attribute("/", "first_body", std::int64_t{pieces.first_body});
        file.write_attribute("/", "piece_group", std::int64_t{pieces.piece_group});
        file.write_attribute("/", "rest_group", std::int64_t{pieces.rest_group});
        file.write("/drift", pieces.drift.data(), {1, 3});
        write_piece_rows(file, "/pieces", pieces.pieces);
        write_piece_column(file, "/pieces/number", pieces.pieces, &PieceRow::number);
        write_piece_column(file, "/pieces/body", pieces.pieces, &PieceRow::body);
        write_piece_column(file, "/pieces/born", pieces.pieces, &PieceRow::born);
        write_piece_column(file, "/pieces/gone", pieces.pieces, &PieceRow::gone);
        write_piece_column(file, "/pieces/load", pieces.pieces, &PieceRow::load);
        write_piece_column(file, "/pieces/radius", pieces.pieces, &PieceRow::radius);
        write_piece_rows(file, "/rest", pieces.rest);
        write_piece_rows(file, "/sheet", pieces.sheet);
        write_piece_column(file, "/sheet/gone", pieces.sheet, &PieceRow::gone);
        file.close();
    }
    keep_file(part, path);
}

PiecesFile read_pieces(const std::filesystem::path& path) { return PiecesReader(path).read(); }

void show_pieces(const PiecesFile& file, RunData& run) {
    RunHeader& header = run.header;
    // floes of the case; ids begin with 1
    const auto others = static_cast<std::size_t>(file.first_body) - 1;
    const auto slots = header.body_shape.size();
    for (const PieceRow& row : file.pieces)
        if (file.first_body < 1 || static_cast<std::size_t>(row.body) > slots)
            throw bad_input(kPiecesName, "is of another run than run.h5", "run the case anew");
    // Shapes and bodies from the first slot on are those of slots at the end of the run: they are
    // replaced by one shape for each piece.
    const auto shapes = static_cast<std::size_t>(
        others < slots ? header.body_shape[others] : static_cast<int>(header.shapes.size()));
    header.shapes.resize(shapes);
    header.body_shape.resize(others);
    header.body_group.resize(others);
    header.body_mass.resize(others);
    header.body_inertia.resize(others);
    // time [s] at which a floe of the case, or the rest of the sheet, breaks off
    constexpr double kNever = std::numeric_limits<double>::infinity();
    header.body_born.assign(others, kNever);
    header.body_breaking_load.assign(others, 0.0);
    for (const PieceRow& row : file.pieces) add_floe(header, row, file.piece_group, row.born);
    header.sheet_group = file.rest_group;
    for (const auto* rows : {&file.rest, &file.sheet})
        for (const PieceRow& row : *rows) add_floe(header, row, file.rest_group, kNever);
    for (std::size_t f = 0; f < run.frames.size(); ++f)
        show_in_frame(file, others, f > 0 ? &run.frames[f - 1] : nullptr, run.frames[f]);
}

}  // namespace ice
