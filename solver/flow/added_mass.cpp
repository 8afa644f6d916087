// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/flow/added_mass.hpp"

#include <fmt/format.h>

#include "common/base/error.hpp"
#include "solver/flow/solve_panels.hpp"
#include "solver/flow/wetted_panels.hpp"

namespace ice {

namespace {

// Panels of a whole body at most [-]: 128 MB of coefficients. More allows shorter edges; memory
// grows with the square.
constexpr std::size_t kMostBodyPanels = 4000;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

Vec6 normals_of(const SourcePanel& panel, const Vec3& at, const Vec3& about) {
    Vec6 out;
    out << panel.normal, (at - about).cross(panel.normal);
    return out;
}

std::vector<Vec3> all_points(const PanelBody& body) {
    std::vector<Vec3> out;
    for (const SourcePanel& p : body.panels)
        for (const Vec3& at : flux_points(p)) out.push_back(at);
    return out;
}

// The other half of a symmetric body.
PanelBody both_halves(const PanelBody& half) {
    PanelBody out{half.panels, false, half.image};
    if (!half.symmetric) return out;
    const auto mirrored = [](const Vec3& p) { return Vec3(p.x(), -p.y(), p.z()); };
    for (const SourcePanel& p : half.panels)
        out.panels.push_back(
            make_panel(mirrored(p.corner[0]), mirrored(p.corner[2]), mirrored(p.corner[1])));
    return out;
}

}  // namespace

Mat6 added_mass(const PanelBody& body, const Vec3& about, double density) {
    const auto n = static_cast<Eigen::Index>(body.panels.size());
    const std::vector<Vec3> points = all_points(body);
    // one right-hand side for each unit velocity: d phi_i / dn = n_i on the hull (section 6)
    Eigen::MatrixXd wanted(n, 6);
    for (Eigen::Index i = 0; i < n; ++i) {
        const SourcePanel& p = body.panels[static_cast<std::size_t>(i)];
        wanted.row(i) = normals_of(p, p.centre, about);
    }
    const Eigen::MatrixXd strength = solve_strengths(body, wanted);
    // A_ij = -rho int phi_i n_j dA, with the mean of three points on each panel
    Mat6 out = Mat6::Zero();
    for (Eigen::Index mode = 0; mode < 6; ++mode) {
        PanelFlow flow;
        flow.body = body;
        flow.strength.assign(strength.col(mode).data(), strength.col(mode).data() + n);
        const std::vector<FlowSample> samples = flow_at(flow, points);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const SourcePanel& p = body.panels[k / 3];
            out.row(mode) -= density * p.area / 3.0 * samples[k].potential *
                             normals_of(p, points[k], about).transpose();
        }
    }
    // Exactly symmetric by Green's theorem; the panels' error is not, and half of it cancels here.
    return 0.5 * (out + out.transpose());
}

PanelBody whole_body(const TriangleMesh& mesh, double longest_edge, double image) {
    PanelBody out{split_triangles(mesh, longest_edge, kMostBodyPanels), false, image};
    if (out.panels.empty())
        throw bad_input(
            "panel size",
            fmt::format("edges of {:g} m give more than {} panels", longest_edge, kMostBodyPanels),
            "allow longer edges");
    return out;
}

ShipAddedMass ship_added_mass(const TriangleMesh& hull, double water, const Vec3& about,
                              double density, double longest_edge) {
    const WettedHull wetted = make_wetted_hull(hull, water, {longest_edge, kMostBodyPanels / 2});
    PanelBody body = both_halves(wetted.body);
    const Vec3 centre = about - Vec3(0, 0, water);  // panels have the water at z = 0
    ShipAddedMass out;
    out.displacement = density * wetted.volume;
    out.panels = body.panels.size();
    // The flat surface is the limit of slow motions, the surface of zero potential that of fast
    // ones.
    body.image = kLid;
    const Mat6 slow = added_mass(body, centre, density);
    body.image = kFreeSurface;
    const Mat6 fast = added_mass(body, centre, density);
    // Surge, sway and yaw are slow, heave, roll and pitch are at wave frequency: couplings between
    // the two limits have no meaning.
    for (const int i : {0, 1, 5})
        for (const int j : {0, 1, 5}) out.matrix(i, j) = slow(i, j);
    for (const int i : {2, 3, 4})
        for (const int j : {2, 3, 4}) out.matrix(i, j) = fast(i, j);
    return out;
}

}  // namespace ice
