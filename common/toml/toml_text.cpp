// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/toml_text.hpp"

#include <fmt/format.h>

namespace ice {

std::string toml_text(const Value& value, const Key& key) {
    // One overload for each alternative of Value. The key decides between whole numbers and floats,
    // and between true and 1, because Value stores them alike.
    struct Writer {
        const Key& key;
        std::string operator()(double v) const {
            // the shortest digits that read back as the same number
            const std::string text = fmt::format("{}", v);
            // TOML floats need a point, an exponent or a name (inf)
            return text.find_first_of(".einf") == std::string::npos ? text + ".0" : text;
        }
        std::string operator()(std::int64_t v) const {
            if (key.kind == Kind::boolean) return v != 0 ? "true" : "false";
            return fmt::format("{}", v);
        }
        std::string operator()(const std::string& v) const {
            std::string out = "\"";
            for (const char c : v) {
                // TOML allows no bare control characters
                if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
                    out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
                    continue;
                }
                if (c == '"' || c == '\\') out += '\\';
                out += c;
            }
            return out + "\"";
        }
        std::string operator()(const std::vector<std::string>& v) const {
            std::string out = "[";
            for (const std::string& word : v) out += (out.size() > 1 ? ", " : "") + (*this)(word);
            return out + "]";
        }
        std::string operator()(const std::vector<double>& v) const {
            const bool whole = key.kind == Kind::integer_list || key.kind == Kind::counts;
            std::string out = "[";
            for (const double x : v)
                out += (out.size() > 1 ? ", " : "") +
                       (whole ? fmt::format("{}", static_cast<std::int64_t>(x)) : (*this)(x));
            return out + "]";
        }
        std::string operator()(const std::vector<std::pair<double, double>>& v) const {
            std::string out = "[";
            for (const auto& [t, u] : v)
                out +=
                    fmt::format("{}[{}, {}]", out.size() > 1 ? ", " : "", (*this)(t), (*this)(u));
            return out + "]";
        }
    };
    return std::visit(Writer{key}, value);
}

}  // namespace ice
