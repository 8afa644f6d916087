// SPDX-License-Identifier: GPL-3.0-or-later
/// Narrow phase: body pairs -> contacts with point, normal, gap and area.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/broad/find_pairs.hpp"
#include "solver/case/case.hpp"
#include "solver/narrow/centres_finder.hpp"
#include "solver/narrow/contact.hpp"
#include "solver/narrow/contact_polygon.hpp"
#include "solver/narrow/contact_rule.hpp"
#include "solver/narrow/deep_seats.hpp"
#include "solver/narrow/dormant_pairs.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// What one thread finds of its pairs, one after the other; of use within find() only.
struct FoundBatch;

/// Finds the contacts of all pairs, in pair order; threads share the pairs, not a pair.
///
/// Within a pair they are ordered by where their spheres lie, y and -y alike, then by gap and
/// place: the order that the solver takes them in is the same for a mirror image (about y = 0).
///
/// Rule "centres" (the paper): every two spheres with gap <= margin are a contact.
/// Rule "surface": every probe sphere (measure_gap_surface) has one contact per face of the other
/// body that it faces: of the spheres that stand for the same face, the laterally nearest, within
/// the shape's `reach`; of faces that meet in an outward edge only the one less deep. So a face's
/// contacts are as many as its probes, not probes times spheres.
///
/// Convex floes that cannot be crushed meet as solids instead: their contacts are the corners of
/// the polygon in which they meet along their separating axis (contact_polygon), at most four.
///
/// Convex bodies that overlap deeper than their spheres tell of meet in that polygon, too; of
/// other solids each seat that lies so deep in the other one is a contact (find_deep_seats).
///
/// Bodies that are apart (separation) by more than the margin have none.
///
/// Crushed spheres stand where the crushing left them; driven out of their body they are gone. A
/// contact's patch is its probe's; under the rule "centres" it is the ice sphere's share, split
/// among the contacts the sphere has with that body, the smaller one between two floes, and counts
/// whole.
///
/// @param margin  [m] per pair is dt times a bound of the pair's closing speed, plus this much
class ContactFinder {
public:
    void find(const Scene& scene, const std::vector<BodyPair>& pairs, ContactRule rule, double dt,
              double margin, std::vector<Contact>& out);
    /// The same contacts, to the last bit; pairs that cannot have come together since they were
    /// last seen apart are not looked at, and of the others only spheres that can.
    /// @pre travel was updated with the present poses and dt
    void find(const Scene& scene, const std::vector<BodyPair>& pairs, const Travel& travel,
              ContactRule rule, double dt, double margin, std::vector<Contact>& out);

private:
    // What was found of a pair: pieces of what one thread found.
    struct Found {
        const FoundBatch* batch = nullptr;
        std::size_t first = 0, count = 0;     // candidates that are contacts
        std::size_t corner = 0, corners = 0;  // or corners of a polygon that are
        std::size_t seat = 0, seats = 0;      // or deep seats
        Vec3 normal = Vec3::Zero();           // and along what
        std::size_t sphere = 0, spheres = 0;  // what is newly known
        std::size_t contact = 0;              // where they begin among all pairs' contacts
    };
    static void meet(const PairView& view, const SeparatingAxes& axes, double most, Found& found,
                     FoundBatch& batch);
    static void keep_polygon(const ContactPolygon* polygon, Found& found, FoundBatch& batch);
    static void keep_seats(const std::vector<DeepSeat>& seats, Found& found, FoundBatch& batch);
    static void keep_candidates(const std::vector<Candidate>& candidates, Found& found,
                                FoundBatch& batch);
    // Makes the contacts of all rows of found_.
    void emit(const Scene& scene, const std::vector<BodyPair>& pairs, ContactRule rule,
              std::vector<Contact>& out);

    // kept between steps: no allocation once warm
    std::vector<DormantPairs::State> states_;  // of all pairs
    std::vector<std::size_t> awake_;           // rows of the pairs that are measured
    std::vector<Found> found_;                 // of these
    DormantPairs dormant_;
    CentresFinder centres_;  // instead of all these under the rule "centres"
};

namespace reference {
/// The contacts of one pair by testing every sphere with every other: the definition for tests.
void find_contacts(const Scene& scene, BodyPair pair, ContactRule rule, double margin,
                   std::vector<Contact>& out);
}  // namespace reference

}  // namespace ice
