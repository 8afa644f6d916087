// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/contact_rows.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <span>

#include "common/base/assert.hpp"
#include "solver/contact/constraint_order.hpp"
#include "solver/contact/responses.hpp"

namespace ice {

namespace {

// Colours that pairs share [-]: the bits of a word for each body. A pair for whose bodies none is
// left gets one of its own and is swept alone, which is slow; a floe has far fewer neighbours.
constexpr int kColours = 64;

void put(LaneVectors& to, std::size_t lane, const Vec3& from) {
    for (int d = 0; d < 3; ++d) to[static_cast<std::size_t>(d)].v[lane] = from[d];
}

void put(std::array<LaneValues, 6>& to, std::size_t lane, const Mat3& m) {
    const double entries[6] = {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
    for (std::size_t k = 0; k < 6; ++k) to[k].v[lane] = entries[k];
}

void put(std::array<LaneValues, 9>& to, std::size_t lane, const Mat3& m) {
    for (int k = 0; k < 9; ++k) to[static_cast<std::size_t>(k)].v[lane] = m(k / 3, k % 3);
}

}  // namespace

std::int32_t ContactRows::local(std::int32_t body) {
    std::int32_t& number = local_[static_cast<std::size_t>(body)];
    if (number < 0) {
        number = static_cast<std::int32_t>(bodies_.size());
        bodies_.push_back(body);
    }
    return number;
}

std::int32_t ContactRows::copy_of_ship() {
    const auto number = static_cast<std::int32_t>(bodies_.size());
    bodies_.push_back(static_cast<std::int32_t>(kShip));
    local_[kShip] = number;
    copies_.push_back(number);
    return number;
}

void ContactRows::find_pairs(const Bodies& bodies, const std::vector<Constraint>& constraints) {
    for (const std::int32_t body : bodies_) local_[static_cast<std::size_t>(body)] = -1;
    local_.resize(bodies.size(), -1);
    bodies_.clear();
    pairs_.clear();
    copies_.clear();
    // Constraints come sorted by pair: a run with the same bodies is one pair. A free ship has a
    // copy per pair (mass splitting), because one ship in hundreds of pairs would need hundreds of
    // colours, one after the other.
    for (std::size_t k = 0; k < which_.size();) {
        const Constraint& c = constraints[which_[k]];
        std::size_t end = k + 1;
        while (end < which_.size() && constraints[which_[end]].a == c.a &&
               constraints[which_[end]].b == c.b)
            ++end;
        const bool copy = c.a == static_cast<std::int32_t>(kShip) && bodies.ship.free;
        const std::int32_t a = copy ? copy_of_ship() : local(c.a);
        pairs_.push_back(
            {a, local(c.b), static_cast<std::int32_t>(k), static_cast<std::int32_t>(end - k), 0});
        k = end;
    }
    set_copies(bodies);
}

// A ship that only turns has no inverse mass. Its copies take least_response instead, as in the
// position correction.
void ContactRows::set_copies(const Bodies& bodies) {
    // n copies, each with 1/n of the mass, respond n times as much as the ship.
    const double copies = static_cast<double>(copies_.size());
    inverse_mass_ = bodies.ship.inverse_mass;
    copy_inverse_mass_ = copies * largest_response(bodies.ship);
    copy_inverse_inertia_ = copies * bodies.ship.inverse_inertia;
    if (copy_inverse_mass_ == 0.0) copy_inverse_mass_ = copies * bodies.ship.least_response;
}

void ContactRows::part_ship() {
    if (!copies_.empty()) parted_ = motion[static_cast<std::size_t>(copies_.front())];
}

void ContactRows::join_ship() {
    if (copies_.empty()) return;
    Vec3 push = Vec3::Zero(), turn = Vec3::Zero();
    for (const std::int32_t copy : copies_) {
        const double* v = motion[static_cast<std::size_t>(copy)].v;
        for (int d = 0; d < 3; ++d) {
            push[d] += v[d] - parted_.v[d];
            turn[d] += v[d + 3] - parted_.v[d + 3];
        }
    }
    // The impulses of all copies act on one ship: undo the copies' mass, apply the ship's. Turns of
    // n copies, each with 1 / n of the inertia, have their mean.
    push = inverse_mass_ * (push / copy_inverse_mass_);
    turn /= static_cast<double>(copies_.size());
    for (int d = 0; d < 3; ++d) {
        parted_.v[d] += push[d];
        parted_.v[d + 3] += turn[d];
    }
    for (const std::int32_t copy : copies_) motion[static_cast<std::size_t>(copy)] = parted_;
}

void ContactRows::colour_pairs(const Bodies& bodies) {
    used_colours_.assign(bodies_.size(), 0);
    int own = kColours;
    const auto is_free = [&](std::int32_t b) {
        return bodies.inverse_mass[static_cast<std::size_t>(bodies_[static_cast<std::size_t>(b)])] >
               0.0;
    };
    for (Pair& p : pairs_) {
        std::uint64_t &a = used_colours_[static_cast<std::size_t>(p.a)],
                      &b = used_colours_[static_cast<std::size_t>(p.b)];
        const bool free_a = is_free(p.a), free_b = is_free(p.b);
        // The smallest colour that neither body has, in the order of the pairs: the same for any
        // number of threads. Immovable bodies are only read, so that pairs may share them within a
        // colour.
        const std::uint64_t used = (free_a ? a : 0) | (free_b ? b : 0);
        p.colour = std::countr_one(used);
        if (p.colour == kColours) {
            // no colour is left: a colour of its own, solved alone
            p.colour = own++;
            continue;
        }
        if (free_a) a |= std::uint64_t{1} << p.colour;
        if (free_b) b |= std::uint64_t{1} << p.colour;
    }
    sort_pairs();
}

// By colour, within a colour by falling counts, within these as they are found. Two passes by
// counting: the second one keeps the order of the first.
void ContactRows::sort_pairs() {
    const auto sort_by = [&](auto key_of) {
        places_.clear();
        for (const Pair& p : pairs_) {
            const std::size_t key = key_of(p);
            if (places_.size() < key + 2) places_.resize(key + 2, 0);
            ++places_[key + 1];
        }
        std::partial_sum(places_.begin(), places_.end(), places_.begin());
        sorted_.resize(pairs_.size());
        for (const Pair& p : pairs_) sorted_[places_[key_of(p)]++] = p;
        pairs_.swap(sorted_);
    };
    std::int32_t most = 0;
    for (const Pair& p : pairs_) most = std::max(most, p.count);
    sort_by([&](const Pair& p) { return static_cast<std::size_t>(most - p.count); });
    sort_by([](const Pair& p) { return static_cast<std::size_t>(p.colour); });
}

void ContactRows::fill_block(const Bodies& bodies, const std::vector<Constraint>& constraints,
                             std::size_t first_pair, std::size_t last_pair) {
    // One block is eight pairs of a colour, one pair in each lane; its rows hold their first,
    // second, ... contacts. Lanes with fewer contacts than the first have rows of zeros, which
    // change nothing.
    PairBlock block;
    BlockInverseInertias inverse_inertias;
    block.first_row = static_cast<std::int32_t>(rows.size());
    block.rows = pairs_[first_pair].count;  // the first has the most
    block.colour = pairs_[first_pair].colour;
    block.a.fill(-1);
    block.b.fill(-1);
    rows.resize(rows.size() + static_cast<std::size_t>(block.rows), ContactRow{});
    const auto body = [&](std::int32_t l) {
        return static_cast<std::size_t>(bodies_[static_cast<std::size_t>(l)]);
    };
    for (std::size_t p = first_pair; p < last_pair; ++p) {
        const Pair& pair = pairs_[p];
        const std::size_t lane = p - first_pair;
        const std::size_t a = body(pair.a), b = body(pair.b);
        block.a[lane] = pair.a;
        block.b[lane] = pair.b;
        // of a free ship each pair has a lighter copy
        const bool copy = a == kShip && !copies_.empty();
        const Mat3& inertia_a = copy ? copy_inverse_inertia_ : bodies.inverse_inertia_world[a];
        block.inverse_mass_a.v[lane] = copy ? copy_inverse_mass_ : bodies.inverse_mass[a];
        block.inverse_mass_b.v[lane] = bodies.inverse_mass[b];
        put(block.inverse_inertia_a, lane, inertia_a);
        put(block.inverse_inertia_b, lane, bodies.inverse_inertia_world[b]);
        put(inverse_inertias.a, lane, inertia_a);
        put(inverse_inertias.b, lane, bodies.inverse_inertia_world[b]);
        for (std::int32_t k = 0; k < pair.count; ++k) {
            const std::size_t n = static_cast<std::size_t>(pair.first + k);
            const Constraint& c = constraints[which_[n]];
            ContactRow& row = rows[static_cast<std::size_t>(block.first_row + k)];
            put(row.normal, lane, c.normal);
            put(row.arm_a, lane, c.arm_a);
            put(row.arm_b, lane, c.arm_b);
            row.friction.v[lane] = c.friction;
            // where end_stage() finds the impulse of constraint which_[n]
            slot_[n] =
                static_cast<std::int32_t>(kLanes) * (block.first_row + k) + static_cast<int>(lane);
        }
    }
    // added mass: the part of 1 / (m + A) that is not 1 / m, which depends on the direction
    if (bodies.have_added_mass()) {
        PairExcess& water = excess.emplace_back();
        for (std::size_t lane = 0; lane < last_pair - first_pair; ++lane) {
            put(water.a, lane, bodies.inverse_mass_excess[body(block.a[lane])]);
            put(water.b, lane, bodies.inverse_mass_excess[body(block.b[lane])]);
        }
    }
    measure_responses(block, inverse_inertias,
                      std::span(rows).subspan(static_cast<std::size_t>(block.first_row)),
                      excess.empty() ? nullptr : &excess.back());
    blocks.push_back(block);
}

void ContactRows::build(const Bodies& bodies, const std::vector<Constraint>& constraints,
                        const std::vector<std::int32_t>& which) {
    ICE_ASSERT(std::is_sorted(which.begin(), which.end()) && are_ordered(constraints));
    blocks.clear();
    rows.clear();
    excess.clear();
    which_.clear();
    for (const std::int32_t k : which)
        if (constraints[static_cast<std::size_t>(k)].can_move) which_.push_back(k);
    slot_.assign(which_.size(), -1);
    find_pairs(bodies, constraints);
    colour_pairs(bodies);
    // by this thread alone: it sweeps the rows, and takes longer to fetch them from another core
    for (std::size_t first = 0; first < pairs_.size();) {
        std::size_t last = first + 1;
        while (last < pairs_.size() && last < first + kLanes &&
               pairs_[last].colour == pairs_[first].colour)
            ++last;
        fill_block(bodies, constraints, first, last);
        first = last;
    }
}

void ContactRows::load_motions(const Bodies& bodies) {
    motion.resize(bodies_.size());
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        const std::size_t body = static_cast<std::size_t>(bodies_[k]);
        const Vec3 &v = bodies.velocity[body], &w = bodies.angular_velocity[body];
        motion[k] = {{v.x(), v.y(), v.z(), w.x(), w.y(), w.z(), 0.0, 0.0}};
    }
}

void ContactRows::set(std::size_t slot, double normal, const Vec3& tangent, const Target& target) {
    ContactRow& row = rows[slot / kLanes];
    const std::size_t lane = slot % kLanes;
    // the target and the bound of the stage, (6); the impulse is the guess or the last
    // solution's
    row.target_velocity.v[lane] = target.target_velocity;
    row.max_impulse.v[lane] = std::max(target.max_impulse, 0.0);
    row.impulse.normal.v[lane] = normal;
    put(row.impulse.tangent, lane, tangent);
}

void ContactRows::end_stage(Bodies& bodies, std::vector<Constraint>& constraints,
                            double Constraint::*normal, Vec3 Constraint::*tangent) const {
    for (std::size_t n = 0; n < which_.size(); ++n) {
        if (slot_[n] < 0) continue;
        Constraint& c = constraints[which_[n]];
        const std::size_t slot = static_cast<std::size_t>(slot_[n]);
        const RowImpulses& impulse = rows[slot / kLanes].impulse;
        const double normal_now = impulse.normal.v[slot % kLanes];
        // a row without an impulse before and after changes nothing; it has no friction either
        if (normal_now == 0.0 && c.*normal == 0.0) continue;
        const Vec3 tangent_now = get(impulse.tangent, slot % kLanes);
        // the rounding of hundreds of small changes stays in `motion`; momentum is balanced
        apply_impulse(bodies, c, (normal_now - c.*normal) * c.normal + (tangent_now - c.*tangent));
        c.*normal = normal_now;
        c.*tangent = tangent_now;
    }
}

}  // namespace ice
