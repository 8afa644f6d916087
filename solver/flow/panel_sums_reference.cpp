// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over source panels, (22): the definition, one point at a time. panel_sums_simd.cpp computes
// the same bits with points in lanes.
#include <algorithm>

#include "solver/flow/own_functions.hpp"
#include "solver/flow/panel_sums.hpp"

namespace ice::reference {

namespace {

struct Flow {
    double x = 0.0, y = 0.0, z = 0.0, phi = 0.0;

    friend Flow operator+(const Flow& a, const Flow& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z, a.phi + b.phi};
    }
};

double dot(const Vec3& a, double x, double y, double z) {
    return (a.x() * x + a.y() * y) + a.z() * z;
}

// 4 pi times the flow of a triangle.
Flow near_flow(const SourcePanel& p, double x, double y, double z) {
    // (22): from each edge ln((r_k + r_k+1 + l) / (r_k + r_k+1 - l)) m_k, from the face Omega
    // n. The potential has the same logarithms and angle, times the heights over edges and
    // face.
    double ax[3], ay[3], az[3], r[3];
    for (std::size_t k = 0; k < 3; ++k) {
        ax[k] = p.corner[k].x() - x;
        ay[k] = p.corner[k].y() - y;
        az[k] = p.corner[k].z() - z;
        r[k] = std::sqrt((ax[k] * ax[k] + ay[k] * ay[k]) + az[k] * az[k]);
    }
    Flow out;
    for (std::size_t k = 0; k < 3; ++k) {
        const double sum = r[k] + r[(k + 1) % 3], l = p.length[k];
        // On the edge itself the logarithm is infinite: bounded, because nodes and control points
        // may lie there.
        const double gap = std::max(sum - l, kLeastGap * l);
        const double log = own::log((sum + l) / gap);
        out.x = out.x + log * p.outward[k].x();
        out.y = out.y + log * p.outward[k].y();
        out.z = out.z + log * p.outward[k].z();
        out.phi = out.phi - log * dot(p.outward[k], ax[k], ay[k], az[k]);
    }
    // tan(Omega / 2) = up / down, the formula of van Oosterom and Strackee
    const auto product = [&](std::size_t i, std::size_t k) {
        return (ax[i] * ax[k] + ay[i] * ay[k]) + az[i] * az[k];
    };
    const double height = dot(p.normal, ax[0], ay[0], az[0]);  // of the plane over the point
    const double up = 2.0 * p.area * height;
    const double down =
        (r[0] * r[1] * r[2] + product(0, 1) * r[2]) + (product(1, 2) * r[0] + product(2, 0) * r[1]);
    const double size = 2.0 * own::half_plane_angle(std::abs(up), down);
    const double angle = height > 0.0 ? -size : size;  // seen from the side of the normal: positive
    out.x = out.x + angle * p.normal.x();
    out.y = out.y + angle * p.normal.y();
    out.z = out.z + angle * p.normal.z();
    out.phi = out.phi - angle * height;
    return out;
}

Flow unit_flow(const SourcePanel& p, double x, double y, double z) {
    const double dx = x - p.centre.x(), dy = y - p.centre.y(), dz = z - p.centre.z();
    const double square = (dx * dx + dy * dy) + dz * dz;
    // Far away a panel is a point source, within the accuracy set by far_squared.
    if (!(square > p.far_squared)) return near_flow(p, x, y, z);
    const double phi = p.area / std::sqrt(square), rate = phi / square;
    return {rate * dx, rate * dy, rate * dz, -phi};
}

// With the images. In pairs, so that a mirrored point has the same sums.
Flow imaged_flow(const PanelBody& body, const SourcePanel& p, double x, double y, double z) {
    const double s = body.image;
    const auto both = [&](double at_y) {
        const Flow own = unit_flow(p, x, at_y, z), image = unit_flow(p, x, at_y, -z);
        return own + Flow{s * image.x, s * image.y, -(s * image.z), s * image.phi};
    };
    const Flow here = both(y);
    if (!body.symmetric) return here;
    const Flow there = both(-y);
    return here + Flow{there.x, -there.y, there.z, there.phi};
}

}  // namespace

void sum_panels(const PanelBody& body, std::span<const double> strength,
                std::span<const Vec3> points, std::span<FlowSample> out) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3& at = points[i];
        Flow sum;
        for (std::size_t j = 0; j < body.panels.size(); ++j) {
            const Flow f = imaged_flow(body, body.panels[j], at.x(), at.y(), at.z());
            const double s = strength[j];
            sum = sum + Flow{s * f.x, s * f.y, s * f.z, s * f.phi};
        }
        out[i].velocity = Vec3(kPerSphere * sum.x, kPerSphere * sum.y, kPerSphere * sum.z);
        out[i].potential = kPerSphere * sum.phi;
    }
}

void mean_fluxes(const PanelBody& body, const FluxTargets& t, std::span<double> out) {
    constexpr std::size_t n = FluxTargets::kCount;
    for (std::size_t j = 0; j < body.panels.size(); ++j)
        for (std::size_t i = 0; i < n; ++i) {
            double sum = 0.0;
            for (std::size_t q = 0; q < 3; ++q) {
                const Flow f = imaged_flow(body, body.panels[j], t.x[q][i], t.y[q][i], t.z[q][i]);
                sum = sum + ((f.x * t.nx[i] + f.y * t.ny[i]) + f.z * t.nz[i]);
            }
            out[n * j + i] = kPerSphere / 3.0 * sum;
        }
}

}  // namespace ice::reference
