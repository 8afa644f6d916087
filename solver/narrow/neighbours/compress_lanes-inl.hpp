// SPDX-License-Identifier: GPL-3.0-or-later
// The lanes that a mask chooses, one after the other. Included once per instruction set, hence the
// guard that lets it in again for each.
#if defined(ICE_COMPRESS_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_COMPRESS_LANES_INL
#undef ICE_COMPRESS_LANES_INL
#else
#define ICE_COMPRESS_LANES_INL
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Highway 1.0.3 has its tables within the function, and g++ 12 copies the whole of them onto the
// stack in every call: the search took five times as long on AVX2.
#define ICE_OWN_COMPRESS (HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4)

#if ICE_OWN_COMPRESS
// By the bits of a mask: the numbers of the lanes that it chooses, then those of the others. The
// first half serves four lanes, too.
struct CompressTable {
    alignas(32) std::int32_t lanes[256][8];
};
constexpr CompressTable make_compress_table() {
    CompressTable out{};
    for (int bits = 0; bits < 256; ++bits) {
        int place = 0;
        for (const int wanted : {1, 0})
            for (int lane = 0; lane < 8; ++lane)
                if ((bits >> lane & 1) == wanted) out.lanes[bits][place++] = lane;
    }
    return out;
}
inline constexpr CompressTable kCompressTable = make_compress_table();
static_assert(kCompressTable.lanes[0b10110][0] == 1 && kCompressTable.lanes[0b10110][1] == 2 &&
              kCompressTable.lanes[0b10110][2] == 4 && kCompressTable.lanes[0b10110][3] == 0);
static_assert(kCompressTable.lanes[0b1000][0] == 3 && kCompressTable.lanes[0b1000][3] == 2);
#endif

// Lanes of four bytes; lanes after the chosen ones mean nothing.
template <class D, class V, class M>
HWY_INLINE V Compressed(D d, V values, M chosen) {
#if ICE_OWN_COMPRESS
    static_assert(sizeof(hn::TFromD<D>) == 4);
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, chosen, bits);
    return hn::TableLookupLanes(values, hn::SetTableIndices(d, kCompressTable.lanes[bits[0]]));
#else
    (void)d;
    return hn::Compress(values, chosen);
#endif
}
#undef ICE_OWN_COMPRESS

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
