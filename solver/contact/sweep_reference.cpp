// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "solver/contact/sweep.hpp"

namespace ice::reference {

namespace {

// Sums in a fixed order: Eigen's depends on its vector width.
struct Vector {
    double x, y, z;
    friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
};
double dot(Vector a, Vector b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
Vector cross(Vector a, Vector b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Vector get(const LaneVectors& from, std::size_t lane) {
    return {from[0].v[lane], from[1].v[lane], from[2].v[lane]};
}

// A body of a pair while its contacts are swept.
struct Side {
    Vector velocity, angular_velocity;
    double inverse_mass, inertia[6];  // inverse, xx yy zz xy xz yz

    Side(const BodyMotion& m, const LaneValues& mass, const std::array<LaneValues, 6>& i,
         std::size_t lane)
        : velocity{m.v[0], m.v[1], m.v[2]},
          angular_velocity{m.v[3], m.v[4], m.v[5]},
          inverse_mass(mass.v[lane]) {
        for (std::size_t k = 0; k < 6; ++k) inertia[k] = i[k].v[lane];
    }
    Vector at(Vector arm) const { return velocity + cross(angular_velocity, arm); }
    void push(Vector arm, Vector j) {
        velocity = velocity + inverse_mass * j;
        const Vector m = cross(arm, j);
        const double* i = inertia;
        angular_velocity = angular_velocity + Vector{(i[0] * m.x + i[3] * m.y) + i[4] * m.z,
                                                     (i[3] * m.x + i[1] * m.y) + i[5] * m.z,
                                                     (i[4] * m.x + i[5] * m.y) + i[2] * m.z};
    }
    void store(BodyMotion& m) const {
        m.v[0] = velocity.x;
        m.v[1] = velocity.y;
        m.v[2] = velocity.z;
        m.v[3] = angular_velocity.x;
        m.v[4] = angular_velocity.y;
        m.v[5] = angular_velocity.z;
    }
};

// Largest changes of velocity so far; the tangential one squared.
struct Changes {
    double normal = 0.0, tangent_sq = 0.0;
};

void solve(ContactRow& row, std::size_t lane, Side& a, Side& b, Changes& most) {
    const Vector n = get(row.normal, lane);
    const Vector arm_a = get(row.arm_a, lane), arm_b = get(row.arm_b, lane);
    const Vector v = b.at(arm_b) - a.at(arm_a);
    double& normal = row.impulse.normal.v[lane];
    const double reached = normal + (row.wanted.v[lane] - dot(n, v)) * row.normal_mass.v[lane];
    const double next = std::min(std::max(reached, 0.0), row.bound.v[lane]);
    const double change = next - normal;
    normal = next;

    const Vector after = v + change * get(row.response, lane);
    const Vector sliding = after - dot(n, after) * n;
    const Vector before = get(row.impulse.tangent, lane);
    Vector tangent = before - row.tangent_mass.v[lane] * sliding;
    const double size_sq = dot(tangent, tangent), limit = row.friction.v[lane] * next;
    if (size_sq > limit * limit) tangent = (limit / std::sqrt(size_sq)) * tangent;
    const Vector turned = tangent - before;
    row.impulse.tangent[0].v[lane] = tangent.x;
    row.impulse.tangent[1].v[lane] = tangent.y;
    row.impulse.tangent[2].v[lane] = tangent.z;

    const Vector j = change * n + turned;
    a.push(arm_a, -1.0 * j);
    b.push(arm_b, j);
    const double k = row.tangent_response.v[lane];
    most.normal = std::max(most.normal, std::abs(change) * row.normal_response.v[lane]);
    most.tangent_sq = std::max(most.tangent_sq, dot(turned, turned) * (k * k));
}

}  // namespace

double sweep(const std::vector<PairBlock>& blocks, std::vector<ContactRow>& rows,
             std::vector<BodyMotion>& motion) {
    Changes most;
    for (const PairBlock& block : blocks)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            if (block.a[lane] < 0) continue;
            BodyMotion &ma = motion[static_cast<std::size_t>(block.a[lane])],
                       &mb = motion[static_cast<std::size_t>(block.b[lane])];
            Side a(ma, block.inverse_mass_a, block.inverse_inertia_a, lane);
            Side b(mb, block.inverse_mass_b, block.inverse_inertia_b, lane);
            for (std::int32_t r = 0; r < block.rows; ++r)
                solve(rows[static_cast<std::size_t>(block.first_row + r)], lane, a, b, most);
            if (a.inverse_mass > 0.0) a.store(ma);
            if (b.inverse_mass > 0.0) b.store(mb);
        }
    return std::max(most.normal, std::sqrt(most.tangent_sq));
}

double measure_change(const std::vector<ContactRow>& rows, const SweepMemory& memory) {
    double sum[kLanes] = {};
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const RowImpulses &now = rows[r].impulse, &before = memory.before[r];
            const double normal = now.normal.v[lane] - before.normal.v[lane];
            const Vector tangent = get(now.tangent, lane) - get(before.tangent, lane);
            sum[lane] +=
                (normal * normal + dot(tangent, tangent)) * rows[r].normal_response.v[lane];
        }
    return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

namespace {

void move_on(double& value, double& before, double& way, double beta) {
    const double change = value - before;
    value = value + beta * way;
    way = beta * way + change;
    before = value;
}

}  // namespace

void move_on(std::vector<ContactRow>& rows, std::vector<BodyMotion>& motion, double beta,
             SweepMemory& memory) {
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            RowImpulses &now = rows[r].impulse, &before = memory.before[r], &way = memory.way[r];
            move_on(now.normal.v[lane], before.normal.v[lane], way.normal.v[lane], beta);
            for (std::size_t d = 0; d < 3; ++d)
                move_on(now.tangent[d].v[lane], before.tangent[d].v[lane], way.tangent[d].v[lane],
                        beta);
        }
    for (std::size_t k = 0; k < motion.size(); ++k)
        for (std::size_t d = 0; d < 8; ++d)
            move_on(motion[k].v[d], memory.motion_before[k].v[d], memory.motion_way[k].v[d], beta);
}

}  // namespace ice::reference
