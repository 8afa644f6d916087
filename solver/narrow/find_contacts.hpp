// SPDX-License-Identifier: GPL-3.0-or-later
/// Narrow phase: body pairs -> contacts with point, normal, gap and area.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/broad/find_pairs.hpp"
#include "solver/case/case.hpp"
#include "solver/narrow/centres_finder.hpp"
#include "solver/narrow/dormant_pairs.hpp"
#include "solver/narrow/patch.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// A place where two bodies touch or may touch within the step.
struct Contact {
    std::int32_t a, b;                ///< bodies, a < b; a = 0 is the ship
    std::int32_t sphere_a, sphere_b;  ///< surface spheres of their shapes
    std::uint64_t key;                ///< the same contact has the same key in the next step
    Vec3 point;                       ///< midway between the surfaces, world axes [m]
    Vec3 normal;                      ///< unit, from a to b
    double gap;                       ///< [m], negative where the surfaces overlap
    Patch patch;                      ///< the surface that presses here
    std::int32_t region;              ///< hull region; -1 between floes
    bool crushes_a;                   ///< the ice that gives way is sphere_a's; else sphere_b's
};

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
    void find(const Scene& scene, const std::vector<BodyPair>& pairs, NormalRule rule, double dt,
              double margin, std::vector<Contact>& out);
    /// The same contacts, to the last bit; pairs that cannot have come together since they were
    /// last seen apart are not looked at, and of the others only spheres that can.
    /// @pre travel was updated with the present poses and dt
    void find(const Scene& scene, const std::vector<BodyPair>& pairs, const Travel& travel,
              NormalRule rule, double dt, double margin, std::vector<Contact>& out);

private:
    // What was found of a pair: pieces of what one thread found.
    struct Found {
        const FoundBatch* batch = nullptr;
        std::size_t first = 0, count = 0;     // candidates that are contacts
        std::size_t sphere = 0, spheres = 0;  // what is newly known
        std::size_t contact = 0;              // where they begin among all pairs' contacts
    };
    // Makes the contacts of all rows of found_.
    void emit(const Scene& scene, const std::vector<BodyPair>& pairs, NormalRule rule,
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
void find_contacts(const Scene& scene, BodyPair pair, NormalRule rule, double margin,
                   std::vector<Contact>& out);
}  // namespace reference

}  // namespace ice
