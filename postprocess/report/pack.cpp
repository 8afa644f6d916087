// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/pack.hpp"

#include <openssl/evp.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/base/error.hpp"

namespace ice::report {

static_assert(std::endian::native == std::endian::little, "arrays are written in this byte order");

void Pack::append(const std::string& name, const char* type, const void* data, std::size_t count,
                  std::size_t size) {
    // arrays begin at multiples of four bytes: the viewer reads them in place
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    table_[name] = {{"type", type}, {"offset", bytes_.size()}, {"count", count}};
    if (count > 0) bytes_.append(static_cast<const char*>(data), count * size);
}

void Pack::add(const std::string& name, const std::vector<float>& values) {
    append(name, "f32", values.data(), values.size(), sizeof(float));
}
void Pack::add(const std::string& name, const std::vector<std::uint32_t>& values) {
    append(name, "u32", values.data(), values.size(), sizeof(std::uint32_t));
}
void Pack::add(const std::string& name, const std::vector<std::uint16_t>& values) {
    append(name, "u16", values.data(), values.size(), sizeof(std::uint16_t));
}
void Pack::add(const std::string& name, const std::vector<std::uint8_t>& values) {
    append(name, "u8", values.data(), values.size(), sizeof(std::uint8_t));
}

void Pack::add_series(const std::string& name, std::vector<std::int16_t> values, std::size_t rows,
                      int order) {
    // Differences of neighbours, once or twice, and low bytes apart from high bytes: smooth
    // series then consist of small numbers, which compress well.
    const auto wrap = [](int difference) { return static_cast<std::int16_t>(difference); };
    for (int pass = 0; pass < order; ++pass)
        for (std::size_t first = 0; first < values.size(); first += rows)
            for (std::size_t k = first + rows - 1; k > first; --k)
                values[k] = wrap(values[k] - values[k - 1]);
    std::string planes(2 * values.size(), '\0');
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto bits = static_cast<std::uint16_t>(values[k]);
        planes[k] = static_cast<char>(bits & 0xff);
        planes[values.size() + k] = static_cast<char>(bits >> 8);
    }
    append(name, "i16", planes.data(), planes.size(), 1);
    table_[name]["count"] = values.size();
    table_[name]["rows"] = rows;
    table_[name]["order"] = order;
}

std::string Pack::text() const {
    const auto fail = [] {
        return run_failed("report", "the run's data cannot be compressed", "free some memory");
    };
    uLongf packed = compressBound(bytes_.size());
    std::vector<Bytef> stream(packed);
    if (compress2(stream.data(), &packed, reinterpret_cast<const Bytef*>(bytes_.data()),
                  bytes_.size(), Z_BEST_COMPRESSION) != Z_OK)
        throw fail();
    // four letters per three bytes, and a zero at the end
    std::string text(4 * ((packed + 2) / 3) + 1, '\0');
    const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), stream.data(),
                                       static_cast<int>(packed));
    if (length < 0) throw fail();
    text.resize(static_cast<std::size_t>(length));
    return text;
}

std::int16_t Quantiser::code(double value) const {
    const double steps = (value - offset) / step;
    return static_cast<std::int16_t>(
        std::isfinite(steps) ? std::clamp(std::round(steps), -32767.0, 32767.0) : 0.0);
}

Quantiser make_quantiser(double low, double high, double finest) {
    // without a finite range any step will do
    if (!(high >= low) || !std::isfinite(high - low)) return {finest > 0.0 ? finest : 1.0, 0.0};
    // 65 000 of the 65 536 steps of 16 bits: rounding at the ends cannot overflow
    const double step = std::max((high - low) / 65000.0, finest);
    return {step > 0.0 ? step : 1.0, 0.5 * (low + high)};
}

}  // namespace ice::report
