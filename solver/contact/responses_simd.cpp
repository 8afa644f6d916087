// SPDX-License-Identifier: GPL-3.0-or-later
// Responses of contacts, as many pairs of a block at a time as the machine has lanes, compiled once
// per instruction set. The mathematics is in responses_reference.cpp.
#include "solver/contact/responses.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/contact/responses_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "solver/contact/row_lanes-inl.hpp"
#include "solver/scene/body_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE Matrices Get(const std::array<LaneValues, 9>& from, std::size_t lane) {
    Matrices out;
    for (std::size_t k = 0; k < 3; ++k)
        out.row[k] = {Get(from[3 * k], lane), Get(from[3 * k + 1], lane),
                      Get(from[3 * k + 2], lane)};
    return out;
}

// The sum of both bodies' excess.
HWY_INLINE Matrices Get(const PairExcess& from, std::size_t lane) {
    const auto entry = [&](std::size_t k)
                           HWY_ATTR { return hn::Add(Get(from.a[k], lane), Get(from.b[k], lane)); };
    const Lanes xx = entry(0), yy = entry(1), zz = entry(2);
    const Lanes xy = entry(3), xz = entry(4), yz = entry(5);
    return {{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}};
}

// [r] m [r] with the matrix [r] of the product r x, without the products with its zeros.
HWY_INLINE Matrices CrossedTwice(Vectors r, const Matrices& m) {
    return {{Cross(Sub(Scale(r.y, m.row[2]), Scale(r.z, m.row[1])), r),
             Cross(Sub(Scale(r.z, m.row[0]), Scale(r.x, m.row[2])), r),
             Cross(Sub(Scale(r.x, m.row[1]), Scale(r.y, m.row[0])), r)}};
}

// K of (5): response_matrix() in its order of operations.
HWY_INLINE Matrices ResponseMatrix(Lanes inverse_mass, const Matrices& inverse_inertia_a,
                                   Vectors arm_a, const Matrices& inverse_inertia_b,
                                   Vectors arm_b) {
    const Lanes zero = hn::Zero(Tag());
    const Matrices a = CrossedTwice(arm_a, inverse_inertia_a),
                   b = CrossedTwice(arm_b, inverse_inertia_b);
    const Vectors own[3] = {
        {inverse_mass, zero, zero}, {zero, inverse_mass, zero}, {zero, zero, inverse_mass}};
    Matrices out;
    for (int k = 0; k < 3; ++k) out.row[k] = Sub(Sub(own[k], a.row[k]), b.row[k]);
    return out;
}

// The axis that n is least along, the first one of equals.
HWY_INLINE Vectors LeastAxis(Vectors n) {
    const Lanes x = hn::Abs(n.x), y = hn::Abs(n.y), z = hn::Abs(n.z), one = All(1.0);
    const Mask is_z = hn::Lt(z, hn::Min(x, y)), is_y = hn::AndNot(is_z, hn::Lt(y, x));
    return {hn::IfThenZeroElse(hn::Or(is_y, is_z), one), hn::IfThenElseZero(is_y, one),
            hn::IfThenElseZero(is_z, one)};
}

HWY_INLINE Lanes LargestTangentResponse(const Matrices& k, Vectors n) {
    // largest eigenvalue of K in the tangent plane, in the reference's order of operations
    const Vectors across = Cross(n, LeastAxis(n));
    const Lanes length = hn::Sqrt(Dot(across, across));
    const Vectors s = {hn::Div(across.x, length), hn::Div(across.y, length),
                       hn::Div(across.z, length)};
    const Vectors t = Cross(n, s), kt = Product(k, t);
    const Lanes ss = Dot(s, Product(k, s)), tt = Dot(t, kt), st = Dot(s, kt);
    // Of the symmetric 2x2 matrix (ss st; st tt): (ss + tt) / 2 + sqrt(((ss - tt) / 2)^2 + st^2).
    const Lanes apart = hn::Sub(ss, tt);
    return hn::Add(hn::Mul(All(0.5), hn::Add(ss, tt)),
                   hn::Sqrt(hn::Add(hn::Mul(hn::Mul(All(0.25), apart), apart), hn::Mul(st, st))));
}

// Eight pairs at a time where rows are filled: the contact stage went from 2.65 to 2.24 ms with
// 1600 packed floes, and constraints need not store the responses.
void MeasureResponses(const PairBlock& block, const BlockInverseInertias& inverse_inertias,
                      std::span<ContactRow> rows, const PairExcess* excess) {
    const Tag d;
    const Lanes one = All(1.0);
    for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
        const Matrices inverse_inertia_a = Get(inverse_inertias.a, lane),
                       inverse_inertia_b = Get(inverse_inertias.b, lane);
        const Lanes inverse_mass =
            hn::Add(Get(block.inverse_mass_a, lane), Get(block.inverse_mass_b, lane));
        const Matrices of_water = excess != nullptr ? Get(*excess, lane) : All(Mat3(Mat3::Zero()));
        for (ContactRow& row : rows) {
            const Vectors n = Get(row.normal, lane);
            const Vectors arm_a = Get(row.arm_a, lane), arm_b = Get(row.arm_b, lane);
            // lanes without a contact compute not-a-numbers, which `put` replaces by zeros
            const Mask there = NotZero(n);
            const auto put = [&](Lanes value, LaneValues& to)
                                 HWY_ATTR { Put(hn::IfThenElseZero(there, value), to, lane); };
            const Vectors turn_a = Product(inverse_inertia_a, Cross(arm_a, n));
            const Vectors turn_b = Product(inverse_inertia_b, Cross(arm_b, n));
            Vectors response =
                Add(Add(Scale(inverse_mass, n), Cross(turn_a, arm_a)), Cross(turn_b, arm_b));
            if (excess != nullptr) response = Add(response, Product(of_water, n));
            put(response.x, row.response[0]);
            put(response.y, row.response[1]);
            put(response.z, row.response[2]);
            Matrices k =
                ResponseMatrix(inverse_mass, inverse_inertia_a, arm_a, inverse_inertia_b, arm_b);
            if (excess != nullptr)
                for (int i = 0; i < 3; ++i) k.row[i] = Add(k.row[i], of_water.row[i]);
            // 1 / k(n) with k(n) = n . K n, and 1 / k_t with the larger eigenvalue in the tangent
            // plane: steps of this length converge for every sliding direction.
            const Lanes effective_mass = hn::Div(one, Dot(n, Product(k, n)));
            const Lanes tangent_effective_mass = hn::Div(one, LargestTangentResponse(k, n));
            put(effective_mass, row.effective_mass);
            put(tangent_effective_mass, row.tangent_effective_mass);
            put(hn::Div(one, effective_mass), row.inverse_effective_mass);
            put(hn::Div(one, tangent_effective_mass), row.tangent_inverse_effective_mass);
        }
    }
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(MeasureResponses);

void measure_responses(const PairBlock& block, const BlockInverseInertias& inverse_inertias,
                       std::span<ContactRow> rows, const PairExcess* excess) {
    HWY_DYNAMIC_DISPATCH(MeasureResponses)(block, inverse_inertias, rows, excess);
}
}  // namespace ice
#endif
