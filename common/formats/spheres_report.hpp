// SPDX-License-Identifier: GPL-3.0-or-later
/// The certificate of a sphere set, spherize's JSON.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ice {

/// One place of the solid where no sphere fits.
struct ThinFeature {
    std::array<double, 3> at{};  ///< [m]
    double size = 0.0;           ///< extent of the unfilled surface there [m]
};

/// Distance of one surface from another, as quantiles by share of its area.
struct SurfaceDistance {
    double p50 = 0.0, p99 = 0.0, max = 0.0;  ///< [m]
    std::array<double, 3> at{};              ///< where it is most [m]
};

/// The solid that was filled against the mesh as it was read, after units and axes.
struct SourceCheck {
    bool known = false;
    double area = 0.0;           ///< of the source [m2]
    SurfaceDistance to_solid;    ///< from the source's outer surface to the solid
    SurfaceDistance to_source;   ///< from the solid's surface to the source, but for the caps
    double caps_area = 0.0;      ///< of the solid, spanned over openings of the source [m2]
    double left_out_area = 0.0;  ///< of the source, in parts that bound nothing of the solid [m2]
    std::array<double, 3> left_out_at{};  ///< a place of them [m]
};

/// Where the ice meets the hull: z within two ice thicknesses of the waterline.
struct IceBelt {
    double draught = 0.0;                 ///< from the lowest point to the water [m]; 0: not given
    double thickness = 0.0;               ///< of the ice [m]
    double low = 0.0, high = 0.0;         ///< z [m]
    SurfaceDistance to_solid, to_source;  ///< as in SourceCheck
    double gap_p99 = 0.0, gap_max = 0.0;  ///< surface to spheres, as in the certificate [m]

    explicit operator bool() const { return draught > 0.0; }
    double water() const { return 0.5 * (low + high); }
    bool contains(double z) const { return draught > 0.0 && z >= low && z <= high; }
};

/// An end of the solid that the spheres do not reach.
struct CutBack {
    std::string part;             ///< "stem", "stern" (by height), "keel" (by length)
    double by = 0.0;              ///< at most [m]
    double from = 0.0, to = 0.0;  ///< z of stem and stern, x of the keel [m]
};

/// Certificate of a sphere set (schema spherize/1, docs/contract.md, section 2). Lengths [m], area
/// [m2], volume [m3], inertia at 1 kg/m3 [kg m2]; in 2D the last three per metre of breadth.
struct SpheresReport {
    int dimension = 3;                                   ///< 3 or 2
    double radius = 0.0, spacing = 0.0;                  ///< [m]
    std::int64_t spheres = 0, surface_spheres = 0;       ///< counts; all, and those of the surface
    double volume = 0.0, area = 0.0;                     ///< [m3], [m2]
    std::array<double, 3> centroid{};                    ///< [m]
    std::array<double, 6> inertia_unit_density{};        ///< xx, yy, zz, xy, xz, yz [kg m2]
    double protrusion_max = 0.0, covering_radius = 0.0;  ///< [m]
    std::array<double, 3> covering_at{};  ///< on the surface, where the covering radius is [m]
    double gap_p50 = 0.0, gap_p99 = 0.0, gap_max = 0.0;              ///< surface to spheres [m]
    double normal_error_mean_deg = 0.0, normal_error_p99_deg = 0.0;  ///< [deg]
    std::vector<ThinFeature> thin_features;                          ///< the largest first
    double unfitted_share = 0.0;     ///< of the wetted surface [-]: no sphere can touch it, and the
                                     ///< nearest is more than half a radius away
    std::int64_t corners = 0;        ///< where a sphere can touch three faces at once
    std::int64_t blind_corners = 0;  ///< of these without a sphere that has the three normals
    std::int64_t outside_dropped = 0;  ///< spheres on the wrong side of the surface
    SourceCheck source;
    IceBelt belt;
    std::vector<CutBack> cut_back;
    std::vector<std::pair<std::string, std::int64_t>> repairs;  ///< step, count
    std::map<std::string, std::string> guessed;
    std::vector<std::string> warnings;
    std::map<std::string, double> seconds;  ///< wall time per stage [s]
    std::string source_mesh, command_line;
};

/// Size of the interior's spheres in the file [bytes]; --mode surface leaves them out.
std::int64_t interior_bytes(const SpheresReport& report);

/// "z -0.5 to 1.5 m (draught 7.5 m, ice 0.5 m): ...": the certificate's line on the ice belt;
/// empty where no draught was given.
std::string ice_belt_text(const SpheresReport& report);

/// "the stem is cut back by up to 1.2 m between z = 6 and 8.5 m".
std::string cut_back_text(const CutBack& cut);

/// The certificate as JSON text.
std::string spheres_report_text(const SpheresReport& report);

}  // namespace ice
