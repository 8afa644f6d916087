// SPDX-License-Identifier: GPL-3.0-or-later
/// Narrow phase: body pairs -> contacts with point, normal, gap and area.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/parallel.hpp"
#include "solver/broad/find_pairs.hpp"
#include "solver/case/case.hpp"
#include "solver/narrow/centres_finder.hpp"
#include "solver/narrow/found_batch.hpp"
#include "solver/narrow/manifold/contact.hpp"
#include "solver/narrow/manifold/contact_rule.hpp"
#include "solver/narrow/neighbours/pair_cache.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Finds the contacts of all pairs, in pair order; threads share the pairs, not a pair.
///
/// Within a pair they are ordered by their spheres' places, y and -y alike, then by gap and place:
/// the solver's order is the same for a mirror image (about y = 0).
///
/// Rule "centres" (the paper): every two spheres with gap <= margin are a contact.
/// Rule "surface": every incident sphere (measure_gap_surface) has one contact per face of the
/// other body, with the laterally nearest sphere of that face within the patch radius; of faces
/// that meet in a convex edge only the one with the smaller penetration (reduce_manifold). So a
/// face has as many contacts as incident spheres, not as many as pairs of spheres.
///
/// Convex floes, and in rigid ice a convex hull, meet as solids instead: their contacts are the
/// corners of the polygon in which they meet along their separating axis (contact_polygon), at most
/// four. Pieces of level ice do so, too: each convex part of one meets each part of the other
/// (find_part_polygons).
///
/// A convex hull and a convex floe that can be crushed meet in that polygon, too, if they overlap
/// deeper than any contact of their spheres; of other solids each seat that lies so deep in the
/// other one is a contact (find_deep_seats).
///
/// Bodies that are apart (separation) by more than the margin have none.
///
/// A crushed sphere is used at its shifted place; one that was shifted out of its body is ignored.
/// A contact's patch is that of its incident sphere. Under the rule "centres" it is the share of
/// the ice sphere, of two floes the smaller one, divided among the sphere's contacts with that
/// body; it is not cut.
///
/// A contact is listed up to a gap of dt times a bound of the pair's closing speed, plus `margin`.
/// No pairs give no contacts.
class ContactFinder {
public:
    /// By a search of every pair.
    /// @param pairs   sorted by a, then b
    /// @param dt      time step [s]
    /// @param margin  largest gap that is listed beyond the step's motion [m]
    /// @param out     its old content is dropped; by (a, b)
    void find(const Scene& scene, const std::vector<BodyPair>& pairs, ContactRule rule, double dt,
              double margin, std::vector<Contact>& out);
    /// The same contacts, to the last bit, from neighbour lists: pairs whose path is shorter than
    /// their clearance are skipped, and of the others only listed spheres are measured. Lists are
    /// kept for pairs that were in the last call, too.
    /// @pre motion was updated with the present poses and dt
    void find(const Scene& scene, const std::vector<BodyPair>& pairs, const MotionBounds& motion,
              ContactRule rule, double dt, double margin, std::vector<Contact>& out);

    /// These bodies have another shape now, or another place than MotionBounds knows: all pairs
    /// with them are searched afresh. @pre sorted
    void forget(const std::vector<std::int32_t>& bodies);

private:
    // Results of a pair: a part of one thread's results.
    struct Found {
        const FoundBatch* batch = nullptr;
        FoundPart candidates;      // that are contacts
        FoundPart corners, seats;  // further contacts: corners of a polygon, or deep seats
        FoundPart spheres;         // newly listed, where the pair's list was renewed
        bool renewed = false;
        std::size_t contact = 0;  // where its contacts begin among those of all pairs
    };
    // Time step [s], margin [m], and the gap up to which a pair's contacts count in the step [m].
    struct Within {
        double step, margin, most;
    };
    // Empties the threads' results.
    void begin_batches();
    static void meet(const PairView& view, ContactRule rule, const SeparatingAxes& axes,
                     const Within& within, Found& found, FoundBatch& batch);
    static void meet_parts(const PairView& view, double most, Found& found, FoundBatch& batch);
    // Contacts of row k from its neighbour list, which is made anew where its skin is used up.
    void find_listed(const Scene& scene, BodyPair pair, std::size_t k, const MotionBounds& motion,
                     const Within& within, Found& found, FoundBatch& batch);
    // These append what was found for the pair at hand to the thread's results.
    static void keep_polygon(Found& found, FoundBatch& batch);
    static void keep_all(Found& found, FoundBatch& batch);
    // Makes the contacts of all rows of found_.
    void emit(const Scene& scene, const std::vector<BodyPair>& pairs, ContactRule rule,
              std::vector<Contact>& out);

    // kept between steps: no allocation once warm
    std::vector<PairCache::State> states_;       // of all pairs
    std::vector<std::size_t> pairs_to_measure_;  // their rows
    std::vector<Found> found_;                   // results of these rows
    PerThread<FoundBatch> batches_;
    PairCache cache_;
    CentresFinder centres_;  // instead of all these under the rule "centres"
};

namespace reference {
/// The contacts of one pair by testing every sphere with every other: the definition for tests.
/// measure_gap, check_depths, reduce_manifold and find_deep_seats are the finder's own: this proves
/// its search, not the contact rule. Without motion: of solids that move it may keep other corners.
/// @param margin  largest gap of a contact [m]
void find_contacts(const Scene& scene, BodyPair pair, ContactRule how, double margin,
                   std::vector<Contact>& out);
}  // namespace reference

}  // namespace ice
