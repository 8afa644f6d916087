// SPDX-License-Identifier: GPL-3.0-or-later
/// The particulars' keys in summary.json; nlohmann's library finds these functions by itself.
#pragma once

#include "common/formats/json_file.hpp"
#include "common/formats/particulars.hpp"

namespace ice {

// from_json: a key that is absent or null leaves the default. A key of another type throws
// nlohmann's exception.

void to_json(Json& json, const ShipParticulars& ship);
void from_json(const Json& json, ShipParticulars& ship);

void to_json(Json& json, const IceParticulars& ice);
void from_json(const Json& json, IceParticulars& ice);

void to_json(Json& json, const CrackParticulars& cracks);
void from_json(const Json& json, CrackParticulars& cracks);

void to_json(Json& json, const TravelParticulars& travel);
void from_json(const Json& json, TravelParticulars& travel);

void to_json(Json& json, const FormulaValue& formula);
void from_json(const Json& json, FormulaValue& formula);

}  // namespace ice
