// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/opening_loops.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "common/geometry/edge_table.hpp"

namespace ice {

namespace {

struct Step {
    std::int32_t to, neighbour;
    bool used = false;
};

class Walker {
public:
    explicit Walker(const TriangleMesh& mesh) : mesh_(mesh) {
        for (const MeshEdge& edge : edge_table(mesh)) {
            // an edge with more triangles one way than the other is open; the walk is against
            // them
            const int net = 2 * edge.forwards - edge.count;
            for (int k = 0; k < std::abs(net); ++k)
                net > 0 ? add(edge.b, edge.a, edge) : add(edge.a, edge.b, edge);
        }
    }

    std::vector<OpeningLoop> walk() {
        for (auto& [start, steps] : from_)
            for (Step& first : steps)
                if (!first.used) follow(start, first);
        return std::move(loops_);
    }

private:
    void add(std::int32_t from, std::int32_t to, const MeshEdge& edge) {
        std::int32_t neighbour = -1;
        for (const std::int32_t t : edge.triangles)
            if (t >= 0 && runs(t, to, from)) neighbour = t;
        from_[from].push_back({to, neighbour});
        if (neighbour < 0) return;
        for (const std::int32_t v : {from, to})
            normals_.try_emplace(v, Vec3::Zero()).first->second +=
                mesh_.area_vector(static_cast<std::size_t>(neighbour)).normalized();
    }

    bool runs(std::int32_t triangle, std::int32_t from, std::int32_t to) const {
        const auto& t = mesh_.triangles[static_cast<std::size_t>(triangle)];
        for (std::size_t k = 0; k < 3; ++k)
            if (t[k] == from && t[(k + 1) % 3] == to) return true;
        return false;
    }

    // Of the edges that leave `at`, the one that turns least into the opening, seen against the
    // surface's normal.
    Step* choose(std::int32_t before, std::int32_t at) {
        Step* best = nullptr;
        double best_angle = 0.0;
        const auto normal = normals_.find(at);
        const auto& vertices = mesh_.vertices;
        const Vec3 here = vertices[static_cast<std::size_t>(at)];
        const Vec3 n = normal == normals_.end() ? Vec3::UnitZ() : normal->second;
        for (Step& step : from_[at]) {
            if (step.used) continue;
            const Vec3 out = vertices[static_cast<std::size_t>(step.to)] - here;
            // the angle from the edge out to the edge back, on the side of the opening
            const Vec3 back = vertices[static_cast<std::size_t>(before)] - here;
            double angle = std::atan2(n.dot(out.cross(back)), n.norm() * out.dot(back));
            if (angle <= 0.0) angle += 2.0 * std::numbers::pi;
            if (best != nullptr && angle >= best_angle) continue;
            best = &step;
            best_angle = angle;
        }
        return best;
    }

    // Walks until it comes back; whenever it meets its own path it cuts off the loop between.
    void follow(std::int32_t start, Step& first) {
        std::vector<std::int32_t> path{start}, along;
        std::map<std::int32_t, std::size_t> place{{start, 0}};
        for (Step* step = &first; step != nullptr;
             step = choose(path[path.size() - 2], path.back())) {
            step->used = true;
            along.push_back(step->neighbour);
            const auto seen = place.find(step->to);
            if (seen == place.end()) {
                place[step->to] = path.size();
                path.push_back(step->to);
                continue;
            }
            // A walk that touches itself in a vertex, as a figure of eight, has a loop on either
            // side of it: each is cut off at its second visit.
            const auto cut = static_cast<std::ptrdiff_t>(seen->second);
            OpeningLoop loop;
            loop.vertices.assign(path.begin() + cut, path.end());
            loop.neighbours.assign(along.begin() + cut, along.end());
            for (std::size_t k = 1; k < loop.vertices.size(); ++k) place.erase(loop.vertices[k]);
            path.resize(seen->second + 1);
            along.resize(seen->second);
            if (loop.vertices.size() > 2) loops_.push_back(std::move(loop));
            if (path.size() == 1) return;
        }
    }

    const TriangleMesh& mesh_;
    std::map<std::int32_t, std::vector<Step>> from_;
    std::map<std::int32_t, Vec3> normals_;
    std::vector<OpeningLoop> loops_;
};

}  // namespace

std::vector<OpeningLoop> opening_loops(const TriangleMesh& mesh) { return Walker(mesh).walk(); }

}  // namespace ice
