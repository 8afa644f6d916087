// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/parallel.hpp"
#include "solver/narrow/manifold/contact.hpp"
#include "solver/narrow/manifold/make_centre_contacts.hpp"
#include "solver/narrow/neighbours/search_pair.hpp"
#include "solver/narrow/neighbours/sphere_lists.hpp"
#include "solver/narrow/neighbours/touching_spheres.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// ContactFinder's search under the rule "centres", where only distances count: spheres that may
/// touch are listed in advance, pair by pair, and the lists measured many spheres at a time. Lists
/// of their own, since features take two thirds of the time and this rule needs none
/// (docs/design-notes.md).
class CentresFinder {
public:
    /// As ContactFinder::find: contacts in pair order, none for no pairs.
    /// @param pairs   sorted; lists are kept for pairs that were in the last call, too
    /// @param dt      time step [s]
    /// @param margin  largest gap that is listed beyond the step's motion [m]
    /// @pre motion was updated with the present poses and dt
    void find(const Scene& scene, const std::vector<BodyPair>& pairs, const MotionBounds& motion,
              double dt, double margin, std::vector<Contact>& out);

private:
    // Two spheres that are to be listed.
    struct Near {
        Vec3 a, b;     // their centres, each in its own body's axes, a's from the list's origin [m]
        double radii;  // sum [m]
        std::int32_t i, j;
    };
    // What one thread finds for its pairs, one pair after the other, and its work memory.
    struct Batch {
        std::vector<Candidate> candidates;
        std::vector<ListedSpheres> listed;
        // of the pair at hand
        PairSearch search;
        std::vector<Near> near;
        TouchingSpheres touching;
        CentreContactsWork contacts;
    };
    // Results of a pair: a part of one thread's results.
    struct Found {
        Batch* batch = nullptr;
        std::size_t first = 0, count = 0;   // candidates
        std::size_t block = 0, blocks = 0;  // spheres listed anew,
        bool anew = false;                  // where they were
    };
    // A pair that has contacts.
    struct Touching {
        BodyPair pair;
        std::size_t found, contact;  // row of found_, place of its first contact
    };
    struct Step {
        const Scene& scene;
        const MotionBounds& motion;
        double dt, margin;
    };
    static void find_near(const PairView& view, double range, PairSearch& search,
                          std::vector<Near>& out);
    static double list_spheres(const std::vector<Near>& near, std::vector<ListedSpheres>& out);
    Found measure_pair(std::size_t k, BodyPair pair, const Step& step, Batch& batch);

    // kept between steps: no allocation once warm
    SphereLists lists_;
    std::vector<std::size_t> pairs_to_measure_;  // their rows
    std::vector<Found> found_;                   // results of these rows
    std::vector<Touching> touching_;
    PerThread<Batch> batches_;
};

}  // namespace ice
