// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "common/formats/summary_file.hpp"
#include "solver/record/long_series.hpp"
#include "solver/record/measure_particulars.hpp"
#include "solver/ship/free_ship.hpp"

namespace ice {

class CheckpointFile;

/// The entries of summary.json on a free ship (docs/contract.md, section 5).
class ShipStatistics {
public:
    /// A step that ended at `time` [s]; means use those from average_from on.
    void add(const FreeShip& ship, const Scene& scene, const Case& parameters, double time);

    /// Its travel since the start. @pre it is free
    FreeTravel travel(const FreeShip& ship, const Scene& scene, const Case& parameters) const;

    /// Fills Summary::ship and the energies of the ship. @pre it is free
    void fill(const FreeShip& ship, const Scene& scene, const Case& parameters,
              Summary& summary) const;

    /// Writes or sets its state, by the file's direction (recorder_state.cpp).
    void carry(CheckpointFile& file);

private:
    void fill_means(const ShipRig& rig, const Case& parameters,
                    std::map<std::string, double>& out) const;

    LongSeries speed_, thrust_, tow_, mooring_;  ///< per averaged step [m/s], [N]
    double power_ = 0.0;                         ///< sum of the power delivered in them [W]
    /// Sums over the averaged steps of the offsets from equilibrium and course in the six motions
    /// [m], [rad], and of their squares. Surge has none.
    SixNumbers sum_{}, square_{};
    double slow_since_ = 0.0;  ///< time of the last step at a speed that is not slow [s]
    bool stuck_ = false;
};

}  // namespace ice
