// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/icebench_peer.hpp"

#include <algorithm>
#include <cmath>

namespace ice::bench {

#ifdef ICE_WITH_BULLET
std::unique_ptr<Peer> make_bullet(const BenchScene& scene);
std::unique_ptr<Peer> make_bullet_convex(const BenchScene& scene);
constexpr auto kMakeBullet = &make_bullet, kMakeBulletConvex = &make_bullet_convex;
#else
constexpr std::nullptr_t kMakeBullet = nullptr, kMakeBulletConvex = nullptr;
#endif
#ifdef ICE_WITH_ODE
std::unique_ptr<Peer> make_ode(const BenchScene& scene);
constexpr auto kMakeOde = &make_ode;
#else
constexpr std::nullptr_t kMakeOde = nullptr;
#endif

const std::vector<PeerKind>& peer_kinds() {
    static const std::vector<PeerKind> kinds{{"bullet", "libbullet-dev", kMakeBullet},
                                             {"bullet-boxes", "libbullet-dev", kMakeBulletConvex},
                                             {"ode", "libode-dev", kMakeOde}};
    return kinds;
}

BoxWater::BoxWater(const Vec3& size, const Case& p)
    : thickness_(size.z()),
      weight_(p.ice_density * p.gravity * size.prod()),
      buoyancy_(p.water_density * p.gravity * size.prod()),
      drag_(0.5 * p.water_density * p.drag_coefficient),
      areas_(size.y() * size.z(), size.x() * size.z(), size.x() * size.y()) {
    const double x4 = std::pow(size.x(), 4), y4 = std::pow(size.y(), 4);
    turning_ = Vec3(size.x() * y4, size.y() * x4, size.z() * (x4 + y4)) / 32.0;
}

WaterLoad BoxWater::load(double height, const Mat3& rotation, const Vec3& velocity,
                         const Vec3& angular_velocity) const {
    const double share = std::clamp(0.5 - height / thickness_, 0.0, 1.0);
    const Vec3 u = rotation.transpose() * velocity, w = rotation.transpose() * angular_velocity;
    WaterLoad out;
    const double drag = -drag_ * share;
    out.force = rotation * (drag * areas_.cwiseProduct(u.cwiseAbs().cwiseProduct(u)));
    out.force.z() += buoyancy_ * share - weight_;
    out.moment = rotation * (drag * turning_.cwiseProduct(w.cwiseAbs().cwiseProduct(w)));
    return out;
}

}  // namespace ice::bench
