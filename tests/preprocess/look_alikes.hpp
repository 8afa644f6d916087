// SPDX-License-Identifier: GPL-3.0-or-later
/// Hulls from formulas with the faults of real ones. What each is said to hold is tested in
/// look_alikes_test.cpp. Axes: x forward, y to port, z up from the waterline; metres.
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice::test {

/// What crosses at the stern of container_ship().
enum class Stern {
    clean,     ///< closed, nothing crosses; no rudder
    rudder,    ///< a rudder below the counter, clear of it
    crossing,  ///< the rudder's head in the counter, and the two sides of the skeg through each
               ///< other within 0.1 L of the stern
};

/// Main dimensions of container_ship() [m]; its waterline is z = 0.
inline constexpr double kShipLength = 230.0, kShipBreadth = 32.2, kShipDepth = 19.0,
                        kShipDraught = 10.8;

/// A container ship after the KCS: bulb, raked stem, flare, transom, skeg. Symmetric about y = 0
/// but for its diagonals. About 4 stations * levels triangles.
TriangleMesh container_ship(Stern stern, int stations = 120, int levels = 40);

/// A naval combatant, 142 x 19 x 13.5 m, T 6.2 m: a fine raked bow and rise of floor.
/// @param fold  the sides change places within this breadth along the keel [m]: they cross there
TriangleMesh combatant(double fold = 0.0, int stations = 160, int levels = 40);

/// A ship's shell of plates, each a closed part, that touch along their edges and enclose a hold:
/// length 100, outer 20 x 10 m, the hold 0.8 of that in each direction.
/// @param gap  between the plates [m]; 0: they share their faces
/// @param outer takes the volume of the envelope [m3]   @param plates takes that of the plates
TriangleMesh double_skin(double gap = 0.0, double* outer = nullptr, double* plates = nullptr);

/// Two demihulls, a bridge deck and 48 posts: 51 closed parts but for 57 planar openings at the
/// posts' ends (39 lack one end, 9 both). @param whole takes the volume without openings [m3]
TriangleMesh catamaran(double* whole = nullptr);

/// What of the mesh lies below a level z; cut triangles get vertices at exactly that height. The
/// cut stays open.
TriangleMesh cut_at(const TriangleMesh& mesh, double z);

/// A container ship in patches that were tessellated one by one, as an IGES file is: neighbours
/// have other vertices on their common curve, and every patch is moved by up to `crack` L.
TriangleMesh patchwise_ship(double crack = 1e-4, int patches = 12);

/// The mesh in the middle of a flow solver's domain: 4 lengths long, 3 wide and deep, facing
/// inwards as such boxes do.
/// @param sea_plane  adds a sheet of two triangles, three lengths square, at z = 0
TriangleMesh in_domain_box(const TriangleMesh& mesh, bool box = true, bool sea_plane = false);

/// A container ship with a bulwark of eight closed plates along the deck edge, whose ends reach
/// through the shell beside the slits between them.
TriangleMesh ship_with_bulwark();

/// Appends a mesh; region names of `more` are not looked at.
void append(TriangleMesh& mesh, const TriangleMesh& more);

}  // namespace ice::test
