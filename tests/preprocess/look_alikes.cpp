// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/preprocess/look_alikes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "common/geometry/mass_properties.hpp"
#include "preprocess/clean/weld.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/make_meshes.hpp"

namespace ice::test {

namespace {

double smooth_step(double x) {
    x = std::clamp(x, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

// Point of the port side at t from the aft end (0) to the stem (1) and s from the keel (0) to the
// deck (1).
using Side = std::function<Vec3(double t, double s)>;

void add_triangle(TriangleMesh& mesh, std::int32_t a, std::int32_t b, std::int32_t c) {
    mesh.triangles.push_back({a, b, c});
    mesh.region.push_back(0);
}

using Row = std::vector<std::int32_t>;

// Faces between two rows of as many vertices; where they collapse, weld() drops them.
void add_strip(TriangleMesh& mesh, const Row& low, const Row& high) {
    for (std::size_t k = 0; k + 1 < low.size(); ++k) {
        add_triangle(mesh, low[k], high[k + 1], high[k]);
        add_triangle(mesh, low[k], low[k + 1], high[k + 1]);
    }
}

Row add_row(TriangleMesh& mesh, int count, const std::function<Vec3(double)>& at) {
    Row row;
    for (int k = 0; k <= count; ++k) {
        row.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
        mesh.vertices.push_back(at(static_cast<double>(k) / count));
    }
    return row;
}

Vec3 mirrored(const Vec3& p) { return {p.x(), -p.y(), p.z()}; }

// Both sides, a deck and a transom (or what closes the aft end) between them.
TriangleMesh close_sides(const Side& side, int stations, int levels) {
    TriangleMesh mesh;
    std::vector<Row> port, starboard;
    for (int k = 0; k <= levels; ++k) {
        const double s = std::pow(static_cast<double>(k) / levels, 1.5);  // finer at the keel
        port.push_back(add_row(mesh, stations, [&](double t) { return side(t, s); }));
        starboard.push_back(
            add_row(mesh, stations, [&](double t) { return mirrored(side(t, s)); }));
    }
    Row aft_port, aft_starboard;
    for (std::size_t k = 0; k < port.size(); ++k) {
        if (k + 1 < port.size()) {
            add_strip(mesh, port[k + 1], port[k]);
            add_strip(mesh, starboard[k], starboard[k + 1]);
        }
        aft_port.push_back(port[k].front());
        aft_starboard.push_back(starboard[k].front());
    }
    add_strip(mesh, starboard.back(), port.back());
    add_strip(mesh, port.front(), starboard.front());
    add_strip(mesh, aft_starboard, aft_port);
    weld(mesh);
    return mesh;
}

Vec3 ship_point(double t, double s) {
    const double z = -kShipDraught + s * kShipDepth;
    const double depth = -z / kShipDraught;  // 1 at the keel
    const double bulb = std::exp(-std::pow((depth - 0.55) / 0.3, 2));
    const double counter = smooth_step((z + 0.35 * kShipDraught) / (0.45 * kShipDraught));
    const double aft = -0.5 * kShipLength + 0.07 * kShipLength * (1.0 - counter);
    const double stem = 0.5 * kShipLength - 6.0 + 0.5 * std::max(z, 0.0) + 7.0 * bulb;
    const double fore = std::max(0.0, (t - 0.6) / 0.4), run = std::max(0.0, (0.33 - t) / 0.33);
    const double full = 9.0 - 6.8 * fore - 7.0 * run;  // of the sections
    const double section = 1.0 - std::pow(1.0 - std::min(s * 1.1, 1.0), full);
    const double bow = 1.0 - std::pow(fore, 1.6 + 1.2 * s);
    const double stern = 1.0 - std::pow(run, 1.8 + 1.5 * counter) * (1.0 - 0.8 * counter);
    const double ahead = std::max(0.0, (t - 0.93) / 0.07);
    const double swell = 2.4 * bulb * smooth_step(4.0 * ahead) * std::sqrt(1.0 - ahead * ahead);
    double y = 0.5 * kShipBreadth * section * bow * stern + swell * std::min(8.0 * s, 1.0);
    if (t == 1.0 || s == 0.0 || (t == 0.0 && counter == 0.0)) y = 0.0;
    return {aft + t * (stem - aft), y, z};
}

// A prism over a foil: chord along x from aft to fore, from one height to another.
TriangleMesh make_rudder(double aft, double fore, double low, double high) {
    constexpr int kAround = 24;
    TriangleMesh mesh;
    const auto ring = [&](double z) {
        Row row;
        for (int k = 0; k < kAround; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / kAround;
            const double along = 0.5 * (1.0 + std::cos(angle));  // 1 at the leading edge
            row.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
            mesh.vertices.emplace_back(aft + along * (fore - aft),
                                       0.12 * (fore - aft) * std::sin(angle) * (0.4 + 0.6 * along),
                                       z);
        }
        row.push_back(row.front());
        return row;
    };
    const Row bottom = ring(low), top = ring(high);
    add_strip(mesh, bottom, top);
    for (int k = 1; k + 1 < kAround; ++k) {
        const auto at = static_cast<std::size_t>(k);
        add_triangle(mesh, bottom[0], bottom[at + 1], bottom[at]);
        add_triangle(mesh, top[0], top[at], top[at + 1]);
    }
    return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
    for (Vec3& v : mesh.vertices) v += by;
    return mesh;
}

// A hexahedron from its eight corners, numbered by the bits x, y, z; outward for a right-handed
// order.
TriangleMesh hexahedron(const std::array<Vec3, 8>& corner) {
    TriangleMesh mesh;
    mesh.vertices.assign(corner.begin(), corner.end());
    constexpr std::int32_t kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& f : kFaces) {
        add_triangle(mesh, f[0], f[1], f[2]);
        add_triangle(mesh, f[0], f[2], f[3]);
    }
    return mesh;
}

}  // namespace

void append(TriangleMesh& mesh, const TriangleMesh& more) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const auto& t : more.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    mesh.region.insert(mesh.region.end(), more.region.begin(), more.region.end());
}

TriangleMesh container_ship(Stern stern, int stations, int levels) {
    TriangleMesh mesh = close_sides(ship_point, stations, levels);
    if (stern == Stern::clean) return mesh;
    const double aft = -0.5 * kShipLength;
    append(mesh, make_rudder(aft + 2.0, aft + 9.0, -kShipDraught + 0.6,
                             stern == Stern::rudder ? -0.55 * kShipDraught : 0.5));
    if (stern == Stern::rudder) return mesh;
    // the skeg's sides through each other: what is thinner than 1.2 m, less 0.3 m on each side
    for (Vec3& v : mesh.vertices)
        if (v.x() > aft + 10.0 && v.x() < aft + 0.09 * kShipLength && v.z() < -2.0 &&
            v.z() > -0.9 * kShipDraught && v.y() != 0.0 && std::abs(v.y()) < 0.6)
            v.y() -= std::copysign(0.3, v.y());
    return mesh;
}

TriangleMesh combatant(double fold, int stations, int levels) {
    constexpr double kLength = 142.0, kBreadth = 19.0, kDepth = 13.5, kDraught = 6.2;
    const Side side = [](double t, double s) {
        const double z = -kDraught + s * kDepth;
        const double fore = std::max(0.0, (t - 0.45) / 0.55), run = std::max(0.0, 0.4 - t) / 0.4;
        const double aft = -0.5 * kLength + 0.1 * kLength * (1.0 - smooth_step(1.6 * s));
        const double stem = 0.5 * kLength - 9.0 + 1.2 * z;
        const double section = 1.0 - std::pow(1.0 - std::min(s * 1.2, 1.0), 4.0 - 2.6 * fore);
        const double bow = std::pow(1.0 - fore, 1.25 - 0.45 * s);
        const double stern = 1.0 - run * run * (1.0 - 0.8 * smooth_step(2.0 * s - 0.3));
        double y = 0.5 * kBreadth * section * bow * stern;
        if (t == 1.0 || s == 0.0) y = 0.0;
        return Vec3(aft + t * (stem - aft), y, z);
    };
    TriangleMesh mesh = close_sides(side, stations, levels);
    for (Vec3& v : mesh.vertices)
        if (v.y() != 0.0 && std::abs(v.y()) < fold) v.y() = -v.y();
    return mesh;
}

TriangleMesh double_skin(double gap, double* outer, double* plates) {
    constexpr int kAlong = 10, kAround = 12;
    constexpr double kHold = 0.8;
    // a spindle of elliptic sections that ends in small flats: radius of the section at t
    const auto skin = [](int i, int j, double scale) {
        const double x = 100.0 * (static_cast<double>(i) / kAlong - 0.5);
        const double angle = 2.0 * std::numbers::pi * (j % kAround) / kAround;
        const double wide = 1.0 - 0.8 * std::pow(x / 50.0, 4);
        return Vec3(scale * Vec3(x, 10.0 * wide * std::cos(angle), 5.0 * wide * std::sin(angle)));
    };
    TriangleMesh mesh;
    const auto add_plate = [&](const std::array<Vec3, 8>& corner) {
        TriangleMesh plate = hexahedron(corner);
        Vec3 middle = Vec3::Zero();
        for (const Vec3& v : plate.vertices) middle += v / 8.0;
        for (Vec3& v : plate.vertices)
            if (gap > 0.0) v -= 0.5 * gap * (v - middle).normalized();
        append(mesh, plate);
    };
    for (int i = 0; i < kAlong; ++i)
        for (int j = 0; j < kAround; ++j)
            add_plate({skin(i, j, kHold), skin(i + 1, j, kHold), skin(i, j, 1.0),
                       skin(i + 1, j, 1.0), skin(i, j + 1, kHold), skin(i + 1, j + 1, kHold),
                       skin(i, j + 1, 1.0), skin(i + 1, j + 1, 1.0)});
    for (const int i : {0, kAlong})  // wedges between the hold's end and the ship's
        for (int j = 0; j < kAround; ++j) {
            const Vec3 in = kHold * Vec3(i == 0 ? -50 : 50, 0, 0), out = in / kHold;
            TriangleMesh wedge;
            wedge.vertices = {in,  skin(i, j, kHold), skin(i, j + 1, kHold),
                              out, skin(i, j, 1.0),   skin(i, j + 1, 1.0)};
            for (const auto& t : {std::array{0, 1, 2},
                                  {3, 5, 4},
                                  {0, 3, 4},
                                  {0, 4, 1},
                                  {1, 4, 5},
                                  {1, 5, 2},
                                  {2, 5, 0},
                                  {5, 3, 0}})
                add_triangle(wedge, t[0], t[1], t[2]);
            if (measure_mass(wedge).volume < 0.0)
                for (auto& t : wedge.triangles) std::swap(t[1], t[2]);
            Vec3 middle = Vec3::Zero();
            for (const Vec3& v : wedge.vertices) middle += v / 6.0;
            for (Vec3& v : wedge.vertices)
                if (gap > 0.0) v -= 0.5 * gap * (v - middle).normalized();
            append(mesh, wedge);
        }
    const double material = measure_mass(mesh).volume;
    if (plates != nullptr) *plates = material;
    if (outer != nullptr) *outer = material / (1.0 - kHold * kHold * kHold);
    return mesh;
}

TriangleMesh catamaran(double* whole) {
    TriangleMesh mesh;
    for (const double y : {-6.0, 6.0})
        append(mesh, moved(make_wigley(30.0, 2.4, 3.0, 40, 10), Vec3(0.0, y, 0.0)));
    append(mesh, moved(make_box_mesh(Vec3(20.0, 14.0, 0.5)), Vec3(0.0, 0.0, 2.0)));
    const TriangleMesh post = make_box_mesh(Vec3(0.3, 0.3, 1.2));
    double volume = measure_mass(mesh).volume;
    for (int k = 0; k < 48; ++k) {
        TriangleMesh open = post;
        volume += measure_mass(post).volume;
        open.triangles.clear();
        for (std::size_t t = 0; t < post.triangles.size(); ++t) {
            const double z = post.area_vector(t).normalized().z();
            const bool gone = k < 9 ? std::abs(z) > 0.5 : z < -0.5;
            if (!gone) open.triangles.push_back(post.triangles[t]);
        }
        open.region.resize(open.triangles.size());
        append(mesh, moved(open, Vec3(-8.5 + 1.5 * (k % 12), -6.0 + 4.0 * (k / 12), 3.0)));
    }
    if (whole != nullptr) *whole = volume;
    return mesh;
}

TriangleMesh cut_at(const TriangleMesh& mesh, double z) {
    TriangleMesh out;
    out.vertices = mesh.vertices;
    out.region_names = mesh.region_names;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> cuts;
    const auto height = [&](std::int32_t v) {
        return mesh.vertices[static_cast<std::size_t>(v)].z() - z;
    };
    const auto cut = [&](std::int32_t a, std::int32_t b) {
        if (a > b) std::swap(a, b);
        const auto [at, fresh] =
            cuts.try_emplace({a, b}, static_cast<std::int32_t>(out.vertices.size()));
        if (fresh) {
            const Vec3 p = mesh.vertices[static_cast<std::size_t>(a)];
            const Vec3 q = mesh.vertices[static_cast<std::size_t>(b)];
            Vec3 on = p + height(a) / (height(a) - height(b)) * (q - p);
            on.z() = z;
            out.vertices.push_back(on);
        }
        return at->second;
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Row below;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            if (height(a) <= 0.0) below.push_back(a);
            if ((height(a) < 0.0 && height(b) > 0.0) || (height(a) > 0.0 && height(b) < 0.0))
                below.push_back(cut(a, b));
        }
        for (std::size_t k = 1; k + 1 < below.size(); ++k) {
            out.triangles.push_back({below[0], below[k], below[k + 1]});
            out.region.push_back(mesh.region[t]);
        }
    }
    weld(out);
    return out;
}

TriangleMesh patchwise_ship(double crack, int patches) {
    TriangleMesh mesh;
    const auto add_patch = [&](int number, int rows, int columns, bool turned,
                               const std::function<Vec3(double, double)>& at) {
        Dice dice{std::mt19937(static_cast<unsigned>(number + 1))};
        const Vec3 by = crack * kShipLength / std::sqrt(3.0) * dice.vector();
        std::vector<Row> grid;
        for (int k = 0; k <= rows; ++k)
            grid.push_back(add_row(mesh, columns, [&](double u) {
                return Vec3(at(u, static_cast<double>(k) / rows) + by);
            }));
        for (std::size_t k = 0; k + 1 < grid.size(); ++k)
            turned ? add_strip(mesh, grid[k + 1], grid[k]) : add_strip(mesh, grid[k], grid[k + 1]);
    };
    int number = 0;
    for (int p = 0; p < patches; ++p) {
        const double from = static_cast<double>(p) / patches, length = 1.0 / patches;
        for (const bool upper : {false, true})
            for (const bool port : {false, true}) {
                const auto at = [&](double u, double v) {
                    const double s = upper ? 0.35 + 0.65 * v : 0.35 * v * std::sqrt(v);
                    const Vec3 q =
                        ship_point(p + 1 == patches && u == 1.0 ? 1.0 : from + length * u, s);
                    return port ? q : mirrored(q);
                };
                // other numbers of rows and columns in every patch
                add_patch(number, 24 + (5 * number) % 7, 30 + (3 * number) % 11, port, at);
                ++number;
            }
        add_patch(number++, 10, 25 + p % 5, false, [&](double u, double v) {
            const Vec3 edge = ship_point(p + 1 == patches && u == 1.0 ? 1.0 : from + length * u, 1);
            return Vec3(edge.x(), (2.0 * v - 1.0) * edge.y(), edge.z());
        });
    }
    add_patch(number, 28, 12, false, [&](double u, double v) {  // the transom
        const Vec3 edge = ship_point(0.0, v);
        return Vec3(edge.x(), (1.0 - 2.0 * u) * edge.y(), edge.z());
    });
    weld(mesh);
    return mesh;
}

TriangleMesh in_domain_box(const TriangleMesh& mesh, bool box, bool sea_plane) {
    Eigen::AlignedBox3d around;
    for (const Vec3& v : mesh.vertices) around.extend(v);
    const double length = around.sizes().maxCoeff();
    TriangleMesh out = mesh;
    if (box) {
        TriangleMesh domain = moved(make_box_mesh(length * Vec3(4.0, 3.0, 3.0)), around.center());
        for (auto& t : domain.triangles) std::swap(t[1], t[2]);
        append(out, domain);
    }
    if (sea_plane) {
        TriangleMesh sea;
        const Vec3 middle(around.center().x(), around.center().y(), 0.0);
        for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
            sea.vertices.push_back(middle + 1.5 * length * Vec3(x, y, 0));
        add_triangle(sea, 0, 1, 2);
        add_triangle(sea, 0, 2, 3);
        append(out, sea);
    }
    return out;
}

TriangleMesh ship_with_bulwark() {
    TriangleMesh mesh = container_ship(Stern::clean);
    const double deck = kShipDepth - kShipDraught;
    for (const double side : {-1.0, 1.0})
        for (int k = 0; k < 4; ++k) {
            const double x = -45.0 + 18.0 * k;  // 17.6 m of plate, 0.4 m of slit
            append(mesh, moved(make_box_mesh(Vec3(17.6, 0.2, 1.4)),
                               Vec3(x, side * (0.5 * kShipBreadth - 0.05), deck + 0.6)));
        }
    return mesh;
}

}  // namespace ice::test
