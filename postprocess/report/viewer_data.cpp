// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/viewer_data.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "postprocess/report/pack.hpp"
#include "postprocess/report/pack_hull.hpp"
#include "postprocess/report/viewer_charts.hpp"
#include "postprocess/statistics/choose_frames.hpp"
#include "postprocess/views/faces.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using nlohmann::json;

namespace {

// Steps of a quaternion component from 0 to 1 [-]: 0.01 degrees, far below a pixel. More bits would
// not be seen and compress worse.
constexpr double kTurns = 8191.0;
// Steps of a load from 0 to the largest [-]: 13 bits; two more of the 16 hold the floe's state.
constexpr double kLoads = 8191.0;
// Triangles of one floe shape in the viewer: a floe is small in the picture. All floes of a shape
// share them, so the number bounds the browser's work rather than the page's size.
constexpr std::size_t kFloeTriangles = 400;

// 1, 2 or 5 times a power of ten: ends of a scale that can be read
double round_up(double value) {
    if (!(value > 0.0)) return 1.0;
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= value * (1.0 - 1e-9)) return factor * power;
    return 10.0 * power;
}

// Single loads are far above all others: colours end where 95 % of them do.
double colours_end(std::vector<double> loads) {
    std::sort(loads.begin(), loads.end());
    return round_up(loads.empty() ? 0.0 : loads[(loads.size() - 1) * 95 / 100]);
}

class Packer {
public:
    Packer(const RunData& run, const RunFigures& figures, std::size_t frames)
        : run_(run),
          figures_(figures),
          chosen_(statistics::choose_frames(run.frames.size(), frames)) {}

    ViewerData make() {
        const std::size_t floes = run_.header.body_shape.size();
        meta_ = {{"dimension", run_.header.dimension},
                 {"floes", floes},
                 {"frames", chosen_.size()},
                 {"charts",
                  pack_charts(all_histories(), figures_.coverage, figures_.average_from, pack_)}};
        add_ship();
        add_shapes();
        add_positions(floes);
        add_orientations(floes);
        add_loads(floes);
        add_pieces();
        meta_["hull"] = pack_hull(figures_.load, pack_);
        add_flow();
        // last, when all arrays have their places
        meta_["arrays"] = pack_.table();
        return {safe_text(meta_.dump()), pack_.text()};
    }

private:
    // JSON is within a script element, which no text of a case may end
    static std::string safe_text(const std::string& text) {
        std::string out;
        for (const char c : text)
            out += c == '<'   ? std::string("\\u003c")
                   : c == '>' ? std::string("\\u003e")
                   : c == '&' ? std::string("\\u0026")
                              : std::string(1, c);
        return out;
    }

    std::vector<History> all_histories() const {
        std::vector<History> all = figures_.histories;
        all.insert(all.end(), figures_.regions.begin(), figures_.regions.end());
        all.insert(all.end(), figures_.moments.begin(), figures_.moments.end());
        all.insert(all.end(), figures_.motions.begin(), figures_.motions.end());
        return all;
    }

    void add_ship() {
        std::vector<float> time, ship, turn;
        // Empty arrays tell the viewer that there is no playback; missing ones would be an error
        // there.
        // without a hull there is nothing to play back
        if (!figures_.load.mesh.triangles.empty())
            for (const std::size_t f : chosen_) {
                time.push_back(static_cast<float>(run_.frames[f].time));
                for (int d = 0; d < 3; ++d)
                    ship.push_back(static_cast<float>(run_.frames[f].ship_position[d]));
                if (!run_.header.ship_is_free) continue;
                for (const double x : run_.frames[f].ship_orientation.coeffs())  // x y z w
                    turn.push_back(static_cast<float>(x));
            }
        pack_.add("frame_time", time);
        pack_.add("ship", ship);
        pack_.add("ship_turn", turn);
    }

    void add_shapes() {
        std::vector<float> vertices;
        std::vector<std::uint32_t> triangles;
        meta_["shapes"] = json::array();
        std::vector<char> in_sheet(run_.header.shapes.size(), 0);
        std::vector<Vec3> shift(run_.header.shapes.size(), Vec3::Zero());
        for (std::size_t b = 0; b < run_.header.body_shape.size(); ++b)
            if (const auto s = static_cast<std::size_t>(run_.header.body_shape[b]); is_sheet(b)) {
                in_sheet[s] = 1;
                if (!chosen_.empty()) {
                    const auto& position = run_.frames[chosen_.front()].position;
                    shift[s] = position[b] - position[placed_as(b)];
                }
            }
        for (std::size_t s = 0; s < run_.header.shapes.size(); ++s) {
            // the hull is packed with its load map
            const TriangleMesh mesh =
                s == 0
                    ? TriangleMesh{}
                    : views::simplify_mesh(run_.header.shapes[s].mesh,
                                           // parts of a sheet leave no gap between them
                                           in_sheet[s] ? run_.header.shapes[s].mesh.triangles.size()
                                                       : kFloeTriangles);
            meta_["shapes"].push_back({{"first_vertex", vertices.size() / 3},
                                       {"first_triangle", triangles.size() / 3},
                                       {"triangles", mesh.triangles.size()}});
            for (const Vec3& v : mesh.vertices) {
                for (int d = 0; d < 3; ++d)
                    vertices.push_back(static_cast<float>(v[d] + shift[s][d]));
                if (s > 0) floe_size_ = std::max(floe_size_, v.norm());
            }
            for (const auto& t : mesh.triangles)
                triangles.insert(triangles.end(), t.begin(), t.end());
        }
        pack_.add("shape_vertices", vertices);
        pack_.add("shape_triangles", triangles);
        std::vector<std::uint32_t> shape(run_.header.body_shape.begin(),
                                         run_.header.body_shape.end());
        pack_.add("body_shape", shape);
    }

    void add_positions(std::size_t floes) {
        std::vector<std::int16_t> codes;
        json scale = json::array(), offset = json::array();
        for (int d = 0; d < 3; ++d) {
            double low = std::numeric_limits<double>::infinity(), high = -low;
            // positions in 16 bits over the range that they have along each axis
            for (const std::size_t f : chosen_)
                for (const Vec3& p : run_.frames[f].position) {
                    low = std::min(low, p[d]);
                    high = std::max(high, p[d]);
                }
            // no finer than a thousandth of a floe: less is not visible, and noise does not
            // compress
            const Quantiser axis = make_quantiser(low, high, 1e-3 * floe_size_);
            scale.push_back(axis.step);
            offset.push_back(axis.offset);
            for (std::size_t b = 0; b < floes; ++b)
                for (const std::size_t f : chosen_)
                    codes.push_back(axis.code(run_.frames[f].position[placed_as(b)][d]));
        }
        meta_["position"] = {{"scale", scale}, {"offset", offset}};
        // places change smoothly: differences of differences are small
        pack_.add_series("position", std::move(codes), rows(), 2);
    }

    void add_orientations(std::size_t floes) {
        std::vector<std::int16_t> codes;
        const Quantiser part{1.0 / kTurns, 0.0};
        for (int d = 0; d < 4; ++d)
            for (std::size_t b = 0; b < floes; ++b)
                for (const std::size_t f : chosen_) {
                    const Eigen::Quaterniond& q = run_.frames[f].orientation[b];
                    codes.push_back(part.code(d == 0 ? q.w() : q.vec()[d - 1]));
                }
        pack_.add_series("orientation", std::move(codes), rows(), 2);
    }

    // mean force of the ship on a floe between two chosen frames [N]
    double mean_load(std::size_t body, std::size_t k) const {
        if (k == 0) return 0.0;
        Vec3 impulse = Vec3::Zero();
        for (std::size_t f = chosen_[k - 1] + 1; f <= chosen_[k]; ++f)
            // frames between two chosen ones count, too: each has the mean since the one before
            impulse += run_.frames[f].contact_force[body] *
                       (run_.frames[f].time - run_.frames[f - 1].time);
        const double time = run_.frames[chosen_[k]].time - run_.frames[chosen_[k - 1]].time;
        return time > 0.0 ? impulse.norm() / time : 0.0;
    }

    void add_loads(std::size_t floes) {
        std::vector<double> loads, pressed;
        for (std::size_t b = 0; b < floes; ++b)
            for (std::size_t k = 0; k < chosen_.size(); ++k) {
                loads.push_back(mean_load(b, k));
                if (loads.back() > 0.0) pressed.push_back(loads.back());
            }
        const double most =
            pressed.empty() ? 0.0 : *std::max_element(pressed.begin(), pressed.end());
        const double end = colours_end(std::move(pressed));
        const ForceUnit unit = choose_unit(end, run_.header.dimension);
        meta_["load"] = {{"max", std::max(most, 1e-9)},
                         {"scale_end", end},
                         {"scale_text", views::readable(end / unit.newtons)},
                         {"half_text", views::readable(0.5 * end / unit.newtons)},
                         {"unit", unit.name}};
        std::vector<std::int16_t> codes;
        for (std::size_t b = 0; b < floes; ++b)
            for (std::size_t k = 0; k < chosen_.size(); ++k) {
                const double share = most > 0.0 ? loads[b * chosen_.size() + k] / most : 0.0;
                const auto state = static_cast<int>(run_.frames[chosen_[k]].state[b]);
                // The root spends more of the 13 bits on small loads, which are the most frequent.
                // The state has the two lowest bits.
                codes.push_back(static_cast<std::int16_t>(
                    4 * static_cast<int>(std::lround(kLoads * std::sqrt(share))) + state));
            }
        pack_.add_series("load", std::move(codes), rows(), 0);
    }

    bool is_sheet(std::size_t body) const {
        return run_.header.sheet_group >= 0 &&
               run_.header.body_group[body] == run_.header.sheet_group;
    }

    // All parts of a sheet are placed as its first one, and their corners are relative to that: the
    // rounding of places leaves no gap between them.
    std::size_t placed_as(std::size_t body) const {
        if (!is_sheet(body)) return body;
        const auto& group = run_.header.body_group;
        return static_cast<std::size_t>(
            std::find(group.begin(), group.end(), run_.header.sheet_group) - group.begin());
    }

    // Of level ice: the time at which each floe broke off [s], -1: never, -2: a part of the sheet;
    // and the load that broke it as a share of the scale's end [-].
    void add_pieces() {
        std::vector<float> born, load;
        // colours by age and by the load that broke each piece, relative to the ends of their
        // scales
        if (!chosen_.empty() && !run_.header.body_born.empty()) {
            const double start = run_.frames[chosen_.front()].time;
            const double age = std::max(run_.frames[chosen_.back()].time - start, 1e-9);
            const auto& loads = run_.header.body_breaking_load;
            std::vector<double> pressed;
            for (const double x : loads)
                if (x > 0.0) pressed.push_back(x);
            const double end = colours_end(std::move(pressed));
            const ForceUnit unit = choose_unit(end, run_.header.dimension);
            meta_["pieces"] = {{"age",
                                {{"scale_end", age},
                                 {"scale_text", views::readable(age)},
                                 {"half_text", views::readable(0.5 * age)},
                                 {"unit", "s"}}},
                               {"load",
                                {{"scale_text", views::readable(end / unit.newtons)},
                                 {"half_text", views::readable(0.5 * end / unit.newtons)},
                                 {"unit", unit.name}}}};
            for (std::size_t b = 0; b < loads.size(); ++b) {
                const double time = run_.header.body_born[b];
                born.push_back(is_sheet(b)           ? -2.0F
                               : std::isfinite(time) ? static_cast<float>(time)
                                                     : -1.0F);
            }
            for (const double x : loads) load.push_back(static_cast<float>(x / end));
        }
        pack_.add("piece_born", born);
        pack_.add("piece_load", load);
    }

    void add_flow() {
        std::vector<float> points, velocities;
        for (std::size_t k = 0; k < run_.header.flow_point.size(); ++k)
            for (int d = 0; d < 3; ++d) {
                points.push_back(static_cast<float>(run_.header.flow_point[k][d]));
                velocities.push_back(static_cast<float>(run_.header.flow_velocity[k][d]));
            }
        pack_.add("flow_point", points);
        pack_.add("flow_velocity", velocities);
    }

    std::size_t rows() const { return std::max<std::size_t>(1, chosen_.size()); }

    const RunData& run_;
    const RunFigures& figures_;
    std::vector<std::size_t> chosen_;  // rows of run_.frames
    double floe_size_ = 0.0;           // largest radius [m]
    Pack pack_;
    json meta_;
};

}  // namespace

ViewerData make_viewer_data(const RunData& run, const RunFigures& figures, std::size_t frames) {
    return Packer(run, figures, frames).make();
}

}  // namespace ice::report
