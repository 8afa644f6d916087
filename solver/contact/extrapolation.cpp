// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/extrapolation.hpp"

#include <algorithm>

namespace ice {

namespace {

// A squeezed floe's impulse grows by the same step in every sweep: beta is 1 to rounding and the
// way must go on. Beyond this the sweeps turned elsewhere.
constexpr double kAfresh = 1.1;

// values += beta way, then way = beta way + change, for the change since `before`
template <class T>
void move_on(std::vector<T>& values, const std::vector<T>& before, std::vector<T>& way,
             double beta) {
    for (std::size_t k = 0; k < values.size(); ++k) {
        const T change = values[k] - before[k];
        values[k] += beta * way[k];
        way[k] = beta * way[k] + change;
    }
}

}  // namespace

void Extrapolation::note(const Bodies& bodies, const std::vector<Constraint>& constraints,
                         const StageImpulses& stage) {
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        normal_[k] = constraints[k].*stage.normal;
        tangent_[k] = constraints[k].*stage.tangent;
    }
    velocity_ = bodies.velocity;
    angular_ = bodies.angular_velocity;
}

void Extrapolation::begin(const Bodies& bodies, const std::vector<Constraint>& constraints,
                          const StageImpulses& stage) {
    normal_.resize(constraints.size());
    tangent_.resize(constraints.size());
    normal_way_.assign(constraints.size(), 0.0);
    tangent_way_.assign(constraints.size(), Vec3::Zero());
    velocity_way_.assign(bodies.size(), Vec3::Zero());
    angular_way_.assign(bodies.size(), Vec3::Zero());
    last_size_ = -1.0;
    note(bodies, constraints, stage);
}

void Extrapolation::advance(Bodies& bodies, std::vector<Constraint>& constraints,
                            const StageImpulses& stage) {
    double size = 0.0;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        if (c.normal_mass == 0.0) continue;
        const double normal = c.*stage.normal - normal_[k];
        const Vec3 tangent = c.*stage.tangent - tangent_[k];
        size += (normal * normal + tangent.squaredNorm()) / c.normal_mass;
    }
    double beta = last_size_ > 0.0 ? size / last_size_ : 0.0;
    beta = beta > kAfresh ? 0.0 : std::min(beta, 1.0);
    last_size_ = size;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        Constraint& c = constraints[k];
        const double normal = c.*stage.normal - normal_[k];
        const Vec3 tangent = c.*stage.tangent - tangent_[k];
        c.*stage.normal += beta * normal_way_[k];
        c.*stage.tangent += beta * tangent_way_[k];
        normal_way_[k] = beta * normal_way_[k] + normal;
        tangent_way_[k] = beta * tangent_way_[k] + tangent;
    }
    move_on(bodies.velocity, velocity_, velocity_way_, beta);
    move_on(bodies.angular_velocity, angular_, angular_way_, beta);
    note(bodies, constraints, stage);
}

}  // namespace ice
