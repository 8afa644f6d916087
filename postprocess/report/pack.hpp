// SPDX-License-Identifier: GPL-3.0-or-later
/// Arrays of a run as text inside a page; read by web/src/data.js.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ice::report {

/// Collects named arrays in one buffer, each beginning at a multiple of 4 bytes, little-endian. A
/// name given twice names the later array.
class Pack {
public:
    void add(const std::string& name, const std::vector<float>& values);
    void add(const std::string& name, const std::vector<std::uint32_t>& values);
    void add(const std::string& name, const std::vector<std::uint16_t>& values);
    void add(const std::string& name, const std::vector<std::uint8_t>& values);

    /// Series of 16-bit numbers, coded so that deflate finds steady motion.
    ///
    /// Each channel is differenced `order` times (modulo 65536; 2 leaves nothing of an even
    /// motion), then all low bytes and all high bytes are stored apart.
    /// @param values [channels x rows], channel after channel; @param rows >= 1, a divisor of their
    ///        number; @param order 0, 1 or 2
    void add_series(const std::string& name, std::vector<std::int16_t> values, std::size_t rows,
                    int order);

    /// {name: {type, offset, count}}, series with rows and order, too.
    const nlohmann::json& table() const { return table_; }
    /// The buffer as a zlib stream in base64. @throws Error (exit code 1) out of memory
    std::string text() const;
    std::size_t bytes() const { return bytes_.size(); }

private:
    void append(const std::string& name, const char* type, const void* data, std::size_t count,
                std::size_t size);
    std::string bytes_;
    nlohmann::json table_ = nlohmann::json::object();
};

/// Numbers of one unit as 16-bit integers: value = integer * step + offset, both in that unit.
struct Quantiser {
    double step = 1.0, offset = 0.0;
    std::int16_t code(double value) const;  ///< nearest integer, cut to 16 bits; NaN: 0
};

/// @param finest no smaller steps than this; @return steps that reach over [low, high] with 65000
/// of them; for a range without extent or not finite, `finest` (or 1) around it
Quantiser make_quantiser(double low, double high, double finest);

}  // namespace ice::report
