// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace ice {

/// What judge_caps refuses, and what it takes for a continued face and for a deck.
struct CapLimits {
    /// Shares [-] above which caps are refused (judge_caps.hpp). Larger ones accept more meshes and
    /// leave more of the volume to a guess; smaller ones refuse meshes whose volume is known well
    /// enough. Of the volume, in doubt by one cap: a larger one lets a single opening decide more
    /// of the mass.
    static constexpr double kDoubt = 0.005;
    /// Of the surface, the largest cap in a file that seems cut off: a larger one passes files that
    /// end in the middle of a hull, a smaller one refuses whole files with an
    /// opening.
    static constexpr double kSuspect = 0.005;
    /// Of the surface, all continued faces together: a larger one passes hulls without a side, a
    /// smaller one refuses barges without a bottom plate.
    static constexpr double kContinued = 0.2;
    /// Of the surface, all small caps together: a larger one lets many small openings hide a large
    /// loss, a smaller one refuses meshes with many openings without volume.
    static constexpr double kLoose = 0.05;
    /// Of the surface, the largest cap of guessed shape at an end: a larger one passes hulls
    /// without a stem, a smaller one refuses those with a pinhole there.
    static constexpr double kEnd = 0.0005;

    /// Area of a cap that continues no neighbour, over the cap's [-], up to which it continues
    /// them: a larger value takes caps with a guessed corner for continued faces, a smaller one
    /// makes rounding a guess.
    static constexpr double kNoGuess = 1e-6;
    /// Distance over the diagonal [-] up to which parallel faces lie in one plane. A larger value
    /// takes faces beside each other for one, a smaller one lets rounding tell faces of one plane
    /// apart.
    static constexpr double kOnePlane = 1e-4;
    /// Planes that a cap may continue, at most [-]: a rim of curved faces has hundreds. More only
    /// take time; with fewer, caps of many faces count as guesses.
    static constexpr std::size_t kMostPlanes = 32;

    /// A deck. Its area seen from above over the whole [-]: a larger value refuses decks with sheer
    /// and camber, a smaller one takes sloping caps for decks.
    static constexpr double kLevel = 0.9;
    /// Sines of the angles, 17 and 37 degrees, by which the walls at its rim lean inwards and
    /// outwards at most. Larger ones take caps on flat surfaces for decks, smaller ones refuse
    /// flared bows.
    static constexpr double kLeansIn = 0.3, kLeansOut = 0.6;
    /// Share of its part's length and breadth that it reaches over [-]: a larger value refuses
    /// decks with a house at an end, a smaller one takes hatches for decks.
    static constexpr double kSpans = 0.6;
    /// Height above the cap over the diagonal [-] from which a corner of the part stands above it:
    /// the cap's triangles cut a rim's curve short. A larger value takes caps below a low house for
    /// decks, a smaller one refuses decks for that curve.
    static constexpr double kStandsAbove = 1e-3;
    /// The same above the cap's lowest corner, from which a corner is compared with the cap's
    /// triangles. It saves time only, as long as it is below kStandsAbove.
    static constexpr double kMayStandAbove = 1e-6;
    static_assert(kMayStandAbove < kStandsAbove);
};

}  // namespace ice
