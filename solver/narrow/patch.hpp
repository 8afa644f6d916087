// SPDX-License-Identifier: GPL-3.0-or-later
/// The piece of surface behind a contact, and how much of it another body's face cuts off.
#pragma once

namespace ice {

/// A probe sphere's share of its surface, seen along the contact normal.
///
/// The share is two wings of side sqrt(share) / 2 that meet under the sphere, their outward normals
/// turned by +-s from the sphere's normal: one plane on a face (s = 0), a roof on an edge.
struct Patch {
    double share = 0.0;       ///< surface the sphere stands for [m2]
    double facing = 1.0;      ///< cosine of the tilt t between the sphere's and the contact's normal
    double spread_cos = 1.0;  ///< of s
    double spread_sin = 0.0;
    double depth = 0.0;  ///< how far the face lies inside the whole surface, crushed ice included;
                         ///< negative before touch [m]
};

/// Area [m2] of the section that a face at `depth` inside the ice cuts from the patch.
///
/// A wing turned away by the angle a = s + t or s - t loses the share
/// min(1, depth / (side / 2 sin a)) of its projected area share / 2 cos a; a wing turned towards
/// the face is cut whole. So a flat patch counts at the first touch, an edge of length l gives
/// depth (1 / tan a_1 + 1 / tan a_2) l as a sharp edge does, and all patches of a body add up to the
/// area of its section, whatever the spheres' radius.
/// Never more than the patch's whole projected area, cos s cos t share.
///
/// Before touch (depth <= 0) only flat wings count.
double cut_area(const Patch& patch, double depth);

}  // namespace ice
