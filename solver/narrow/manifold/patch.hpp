// SPDX-License-Identifier: GPL-3.0-or-later
/// The piece of surface behind a contact, and how much of it another body's face cuts off.
#pragma once

namespace ice {

/// An incident sphere's share of its surface, seen along the contact normal.
///
/// The share is two wings of equal area that meet at the foot, where the sphere's normal leaves the
/// surface; their outward normals are turned by +-s from it: one plane on a face (s = 0), a roof on
/// an edge.
struct Patch {
    double share = 0.0;   ///< of the surface, that the sphere represents [m2]; 2D: a length [m]
    double facing = 1.0;  ///< cosine of the tilt t between the sphere's and the contact's normal
    double spread_cos = 1.0;  ///< of s: 1 on a face
    double spread_sin = 0.0;  ///< of s: 0 on a face
    double wing = 0.0;        ///< length of a wing, from the foot [m]
    double foot =
        0.0;  ///< height of the foot below the incident support point along the normal [m]
    double depth =
        0.0;  ///< depth of the face inside the incident support point, crushed ice included;
              ///< negative before touch [m]
};

/// Length of the wings of a sphere's share [m]: wing x 2 x spacing = share, where the wing descends
/// from the foot past the point of touch, at r tan s, by half the spacing. With touch = r tan s the
/// wing w solves 4 w (w - touch) = share; half the root of the share on a face. In 2D a wing is
/// half the share, and this is not used.
/// @param radius  of the sphere [m] @param share  > 0 [m2]
/// @param spread_cos, spread_sin  of the normal cone's half angle s; a cosine below 0.001 counts so
double wing_length(double radius, double share, double spread_cos, double spread_sin);

/// Area [m2] of the section that a face at `depth` inside the support cuts from the patch, A of
/// equation (13); in 2D a length [m], area per metre of breadth.
///
/// A wing turned away by the angle a = s + t or s - t lies below the foot by up to wing sin a, and
/// of its projected area share / 2 cos a that part is cut which lies above the face; a wing turned
/// towards the face rises from the foot. So a flat patch counts whole at the first touch, an edge
/// of length l gives depth (1 / tan a_1 + 1 / tan a_2) l as a sharp edge does, and all patches of a
/// body add up to the area of its section, whatever the spheres' radius. Never more than the
/// patch's whole projected area, share cos s cos t, nor less than 5 % of what it would give
/// upright: nothing passes through a side unresisted. Where the two limits contradict each other,
/// as of a patch that faces backwards, the lower one wins.
///
/// @param depth  of the other body's face below the incident support point, along the contact's
///               normal, crushed ice included [m]; below 0 counts as 0, the area at first touch
double cut_area(const Patch& patch, double depth);

}  // namespace ice
