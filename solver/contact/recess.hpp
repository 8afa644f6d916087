// SPDX-License-Identifier: GPL-3.0-or-later
/// Crushed ice beside crushed contact spheres (docs/method.md, section 5).
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "solver/contact/constraints.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

class CheckpointFile;

/// Crushing moves single contact spheres, but a body that has crushed ice lies in a recess of its
/// own shape. As the bodies slide or turn, their contact passes from a crushed sphere to a whole
/// neighbour in the same recess, which then seems to overlap by the depth of the recess at once.
///
/// A contact may be deeper than the deepest one of its pair in the last step only by the distance
/// that the two bodies came closer there within the step. Any further depth is ice that was crushed
/// before: its sphere moves by as much (equation (13a)), without force or work, but not deeper than
/// its deepest neighbour was before the step. Several contacts of one sphere move it once.
///
/// Rejected: the deepest crushed sphere of the whole body in place of the neighbours. With it more
/// pairs shared room unseen (docs/design-notes.md).
class Recess {
public:
    /// Moves such spheres, and takes their shift out of the contacts' overlaps. Its first call only
    /// remembers the pairs' depths. Rigid ice has no recess.
    /// @param dt           time step [s]
    /// @param constraints  of the contacts, one each; their gaps grow as the contacts' do
    /// @pre contacts ordered by (a, b), as ContactFinder gives them; MotionBounds has seen
    /// scene.crushed.recent, which is begun anew here
    void move_spheres(Scene& scene, const ContactLaw& law, double dt,
                      std::vector<Contact>& contacts, std::vector<Constraint>& constraints);

    /// These bodies have another shape now: contacts with them have no past in the coming step, so
    /// that none of their spheres moves.
    /// @pre sorted
    void forget(const std::vector<std::int32_t>& bodies);

    /// Writes or sets its state, by the file's direction. @pre no body was forgotten since the step
    void carry(CheckpointFile& file);

private:
    struct Entry {
        std::int32_t a, b;
        double depth;  ///< of the pair's deepest contact in the last step, at least 0 [m]
    };
    // The ice's sphere of a contact.
    struct Place {
        std::int32_t body, sphere;
        auto operator<=>(const Place&) const = default;
    };
    struct Move {
        Place place;
        std::size_t contact;  // that needs it
        Vec3 shift;           // of the sphere, body axes [m]
    };
    static Place place_of(const Contact& c);
    bool has_past(const Contact& c) const;
    // One move for each sphere, sorted; from the depths before any of them.
    void find_moves(const Scene& scene, double dt, const std::vector<Contact>& contacts,
                    const std::vector<Constraint>& constraints);
    // Depth of the contact's pair in the last step [m]; `at` is an entry at which to begin.
    double last_depth(const Contact& c, std::size_t& at) const;
    void remember(const std::vector<Contact>& contacts);

    std::vector<Entry> entries_;         ///< sorted by (a, b)
    std::vector<std::int32_t> unknown_;  ///< bodies without a past, until the next step
    std::vector<Move> moves_;            ///< memory of move_spheres
    std::uint8_t started_ = 0;           ///< 1 once the depths of a step are known
};

}  // namespace ice
