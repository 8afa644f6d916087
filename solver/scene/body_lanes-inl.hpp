// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies beside each other, as many as the machine has lanes. Included once per instruction set,
// hence the guard that lets it in again for each. Sums have the order of ordered_products.hpp.
#if defined(ICE_BODY_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_BODY_LANES_INL
#undef ICE_BODY_LANES_INL
#else
#define ICE_BODY_LANES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "common/math/vector_lanes-inl.hpp"
#include "solver/scene/bodies.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

struct Matrices {
    Vectors row[3];
};
struct Quaternions {
    Lanes x, y, z, w;
};

HWY_INLINE Lanes All(double value) { return hn::Set(Tag(), value); }
HWY_INLINE Matrices All(const Mat3& m) {
    return {{{All(m(0, 0)), All(m(0, 1)), All(m(0, 2))},
             {All(m(1, 0)), All(m(1, 1)), All(m(1, 2))},
             {All(m(2, 0)), All(m(2, 1)), All(m(2, 2))}}};
}
HWY_INLINE Quaternions Choose(Mask which, Quaternions yes, Quaternions no) {
    return {hn::IfThenElse(which, yes.x, no.x), hn::IfThenElse(which, yes.y, no.y),
            hn::IfThenElse(which, yes.z, no.z), hn::IfThenElse(which, yes.w, no.w)};
}
HWY_INLINE Mask NotZero(Vectors v) {
    const Lanes zero = hn::Zero(Tag());
    return hn::Not(hn::And(hn::And(hn::Eq(v.x, zero), hn::Eq(v.y, zero)), hn::Eq(v.z, zero)));
}

// a + (b + c), where Dot is (a + b) + c
HWY_INLINE Lanes DotFromLast(Vectors a, Vectors b) {
    return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}
HWY_INLINE Vectors Product(const Matrices& m, Vectors v) {
    return {Dot(m.row[0], v), Dot(m.row[1], v), DotFromLast(m.row[2], v)};
}
HWY_INLINE Matrices Transposed(const Matrices& m) {
    return {{{m.row[0].x, m.row[1].x, m.row[2].x},
             {m.row[0].y, m.row[1].y, m.row[2].y},
             {m.row[0].z, m.row[1].z, m.row[2].z}}};
}
HWY_INLINE Vectors TransposedProduct(const Matrices& m, Vectors v) {
    const Matrices t = Transposed(m);
    return {Dot(t.row[0], v), Dot(t.row[1], v), Dot(t.row[2], v)};
}
HWY_INLINE Matrices Turned(const Matrices& r, const Matrices& t) {
    const Matrices columns = Transposed(t);
    const Matrices half = Transposed(
        {{Product(r, columns.row[0]), Product(r, columns.row[1]), Product(r, columns.row[2])}});
    const auto row = [&](Vectors v) HWY_ATTR {
        return Vectors{DotFromLast(v, r.row[0]), DotFromLast(v, r.row[1]),
                       DotFromLast(v, r.row[2])};
    };
    return {{row(half.row[0]), row(half.row[1]), row(half.row[2])}};
}
HWY_INLINE Vectors Turned(const Matrices& r, const Matrices& t, Vectors v) {
    return Product(r, Product(t, TransposedProduct(r, v)));
}

// Quaternion::toRotationMatrix()
HWY_INLINE Matrices RotationOf(Quaternions q) {
    const Lanes one = All(1.0), two = All(2.0);
    const Lanes tx = hn::Mul(two, q.x), ty = hn::Mul(two, q.y), tz = hn::Mul(two, q.z);
    const Lanes wx = hn::Mul(tx, q.w), wy = hn::Mul(ty, q.w), wz = hn::Mul(tz, q.w);
    const Lanes xx = hn::Mul(tx, q.x), xy = hn::Mul(ty, q.x), xz = hn::Mul(tz, q.x);
    const Lanes yy = hn::Mul(ty, q.y), yz = hn::Mul(tz, q.y), zz = hn::Mul(tz, q.z);
    return {{{hn::Sub(one, hn::Add(yy, zz)), hn::Sub(xy, wz), hn::Add(xz, wy)},
             {hn::Add(xy, wz), hn::Sub(one, hn::Add(xx, zz)), hn::Sub(yz, wx)},
             {hn::Sub(xz, wy), hn::Add(yz, wx), hn::Sub(one, hn::Add(xx, yy))}}};
}

// As many bodies as there are lanes, or fewer, ascending; lanes beyond them hold the first.
class BodyLanes {
public:
    HWY_INLINE explicit BodyLanes(std::span<const std::int32_t> bodies)
        : body_(bodies.data()), count_(bodies.size()) {
        in_row_ = count_ == hn::Lanes(Tag()) &&
                  body_[count_ - 1] - body_[0] == static_cast<std::int32_t>(count_) - 1;
    }

    HWY_INLINE Lanes Load(const std::vector<double>& from) const {
        Stage<1> stage;
        return hn::LoadU(Tag(), Gather<1>(from.data(), stage));
    }
    HWY_INLINE Vectors Load(const std::vector<Vec3>& from) const {
        Stage<3> stage;
        Vectors out;
        hn::LoadInterleaved3(Tag(), Gather<3>(from.data()->data(), stage), out.x, out.y, out.z);
        return out;
    }
    HWY_INLINE Quaternions Load(const std::vector<Quaternion>& from) const {
        Stage<4> stage;
        Quaternions out;
        hn::LoadInterleaved4(Tag(), Gather<4>(from.data()->coeffs().data(), stage), out.x, out.y,
                             out.z, out.w);
        return out;
    }
    // One matrix of each body's moments of inertia.
    HWY_INLINE Matrices Load(const Bodies& bodies, Mat3 Inertia::*which) const {
        const std::int32_t first = bodies.inertia_row[static_cast<std::size_t>(body_[0])];
        bool alike = true;
        for (std::size_t k = 1; k < count_; ++k)
            alike &= bodies.inertia_row[static_cast<std::size_t>(body_[k])] == first;
        if (alike) return All(bodies.inertias[static_cast<std::size_t>(first)].*which);
        HWY_ALIGN double entry[9][kMostLanes];
        for (std::size_t k = 0; k < hn::Lanes(Tag()); ++k) {
            const auto row =
                bodies.inertia_row[static_cast<std::size_t>(body_[k < count_ ? k : 0])];
            const Mat3& m = bodies.inertias[static_cast<std::size_t>(row)].*which;
            for (int e = 0; e < 9; ++e) entry[e][k] = m.data()[e];
        }
        Lanes m[9];
        for (int e = 0; e < 9; ++e) m[e] = hn::Load(Tag(), entry[e]);
        return {{{m[0], m[3], m[6]}, {m[1], m[4], m[7]}, {m[2], m[5], m[8]}}};
    }

    HWY_INLINE void Store(Vectors v, std::vector<Vec3>& to) const {
        Stage<3> stage;
        double* const at = in_row_ ? to[static_cast<std::size_t>(body_[0])].data() : stage.v;
        hn::StoreInterleaved3(v.x, v.y, v.z, Tag(), at);
        Scatter<3>(stage, to.data()->data());
    }
    HWY_INLINE void Store(Quaternions q, std::vector<Quaternion>& to) const {
        Stage<4> stage;
        double* const at =
            in_row_ ? to[static_cast<std::size_t>(body_[0])].coeffs().data() : stage.v;
        hn::StoreInterleaved4(q.x, q.y, q.z, q.w, Tag(), at);
        Scatter<4>(stage, to.data()->coeffs().data());
    }
    // Columns are vectors: entries beside each other to columns, these to matrices.
    HWY_INLINE void Store(const Matrices& m, std::vector<Mat3>& to) const {
        const Tag d;
        constexpr std::size_t n = kMostLanes;
        HWY_ALIGN double of_row[3][3 * n];
        for (int r = 0; r < 3; ++r)
            hn::StoreInterleaved3(m.row[r].x, m.row[r].y, m.row[r].z, d, of_row[r]);
        Stage<9> stage;
        double* const at = in_row_ ? to[static_cast<std::size_t>(body_[0])].data() : stage.v;
        for (std::size_t k = 0; k < 3 * n; k += n)
            hn::StoreInterleaved3(hn::Load(d, of_row[0] + k), hn::Load(d, of_row[1] + k),
                                  hn::Load(d, of_row[2] + k), d, at + 3 * k);
        Scatter<9>(stage, to.data()->data());
    }

private:
    template <std::size_t kSize>
    struct Stage {
        HWY_ALIGN double v[kSize * kMostLanes];
    };
    // Records of kSize numbers, one after the other.
    template <std::size_t kSize>
    HWY_INLINE const double* Gather(const double* from, Stage<kSize>& stage) const {
        if (in_row_) return from + kSize * static_cast<std::size_t>(body_[0]);
        for (std::size_t k = 0; k < hn::Lanes(Tag()); ++k)
            std::memcpy(stage.v + kSize * k,
                        from + kSize * static_cast<std::size_t>(body_[k < count_ ? k : 0]),
                        kSize * sizeof(double));
        return stage.v;
    }
    template <std::size_t kSize>
    HWY_INLINE void Scatter(const Stage<kSize>& stage, double* to) const {
        if (in_row_) return;
        for (std::size_t k = 0; k < count_; ++k)
            std::memcpy(to + kSize * static_cast<std::size_t>(body_[k]), stage.v + kSize * k,
                        kSize * sizeof(double));
    }

    const std::int32_t* body_;
    std::size_t count_;
    bool in_row_;
};

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
