// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/siconos/siconos_solver.hpp"

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <SparseBlockMatrix.h>
#include <fc3d_Solvers.h>
#include <fc3d_compute_error.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>

namespace ice::oracle {

namespace {

// Siconos' error [-] at which a solution ends. README.md's table shows the difference of the forces
// that remains.
constexpr double kTolerance = 1e-7;

// The contact's frame as columns: normal, two tangents.
Mat3 frame_of(const Constraint& c) {
    Mat3 out;
    out.col(0) = c.normal;
    out.col(1) = c.normal.unitOrthogonal();
    out.col(2) = c.normal.cross(out.col(1));
    return out;
}

// Change of a body's velocity at arm `at` by a unit impulse at arm `by`: (5), written anew.
Mat3 response(const Bodies& bodies, std::int32_t body, const Vec3& at, const Vec3& by) {
    const auto cross = [](const Vec3& v) {
        Mat3 out;
        out << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
        return out;
    };
    Mat3 out = bodies.inverse_mass[body] * Mat3::Identity() -
               cross(at) * bodies.inverse_inertia_world[body] * cross(by);
    if (bodies.have_added_mass()) out += bodies.inverse_mass_excess[body];
    return out;
}

// Contacts by moving body, with the sign of the impulse that the body gets.
struct Touch {
    std::size_t contact;
    double sign;
    Vec3 arm;
};
std::map<std::int32_t, std::vector<Touch>> touches_of(const Bodies& bodies,
                                                      std::span<const Constraint> contacts) {
    std::map<std::int32_t, std::vector<Touch>> out;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const Constraint& c = contacts[k];
        if (bodies.inverse_mass[c.a] > 0.0) out[c.a].push_back({k, -1.0, c.arm_a});
        if (bodies.inverse_mass[c.b] > 0.0) out[c.b].push_back({k, 1.0, c.arm_b});
    }
    return out;
}

// Delassus' matrix W: changes of all contacts' velocities by all their impulses, in their frames.
NumericsMatrix* response_of_all(const Bodies& bodies, std::span<const Constraint> contacts) {
    std::vector<std::map<std::size_t, Mat3>> rows(contacts.size());
    for (const auto& [body, touches] : touches_of(bodies, contacts))
        for (const Touch& i : touches)
            for (const Touch& j : touches) {
                const Mat3 block =
                    i.sign * j.sign *
                    (frame_of(contacts[i.contact]).transpose() *
                     response(bodies, body, i.arm, j.arm) * frame_of(contacts[j.contact]));
                rows[i.contact].try_emplace(j.contact, Mat3::Zero()).first->second += block;
            }
    const int size = 3 * static_cast<int>(contacts.size());
    std::size_t blocks = 0;
    for (const auto& row : rows) blocks += row.size();
    NumericsMatrix* triplets = NM_create(NM_SPARSE, size, size);
    NM_triplet_alloc(triplets, static_cast<CS_INT>(9 * blocks));
    triplets->matrix2->origin = NSM_TRIPLET;
    for (std::size_t k = 0; k < rows.size(); ++k)
        for (const auto& [other, block] : rows[k])
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c)
                    NM_entry(triplets, 3 * static_cast<int>(k) + r, 3 * static_cast<int>(other) + c,
                             block(r, c));
    SparseBlockStructuredMatrix* block_matrix = SBM_new();
    SBM_from_csparse(3, NM_csc(triplets), block_matrix);
    NM_clear(triplets);
    std::free(triplets);
    return NM_new_SBM(size, size, block_matrix);
}

}  // namespace

ConeSolution solve_cones(const Bodies& bodies, std::span<const Constraint> contacts,
                         std::span<const double> target, int most) {
    ConeSolution out;
    if (contacts.empty()) return out;
    const std::size_t size = 3 * contacts.size();
    // the problem frees its arrays with free()
    auto* q = static_cast<double*>(std::calloc(size, sizeof(double)));
    auto* mu = static_cast<double*>(std::calloc(contacts.size(), sizeof(double)));
    if (!q || !mu) throw std::bad_alloc();
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const Vec3 free =
            frame_of(contacts[k]).transpose() * relative_velocity(bodies, contacts[k]);
        for (int d = 0; d < 3; ++d) q[3 * k + static_cast<std::size_t>(d)] = free[d];
        q[3 * k] -= target[k];
        mu[k] = contacts[k].friction;
    }
    const std::unique_ptr<FrictionContactProblem, void (*)(FrictionContactProblem*)> problem(
        frictionContactProblem_new_with_data(3, static_cast<int>(contacts.size()),
                                             response_of_all(bodies, contacts), q, mu),
        frictionContactProblem_free);
    const std::unique_ptr<SolverOptions, void (*)(SolverOptions*)> options(
        solver_options_create(SICONOS_FRICTION_3D_NSGS), [](SolverOptions* o) {
            solver_options_delete(o);
            std::free(o);
        });
    options->iparam[SICONOS_IPARAM_MAX_ITER] = most;
    options->dparam[SICONOS_DPARAM_TOL] = kTolerance;
    std::vector<double> reaction(size, 0.0), velocity(size, 0.0);
    fc3d_driver(problem.get(), reaction.data(), velocity.data(), options.get());
    out.error = options->dparam[SICONOS_DPARAM_RESIDU];
    out.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
    for (std::size_t k = 0; k < contacts.size(); ++k)
        out.impulse.emplace_back(frame_of(contacts[k]) *
                                 Vec3(reaction[3 * k], reaction[3 * k + 1], reaction[3 * k + 2]));
    return out;
}

}  // namespace ice::oracle
