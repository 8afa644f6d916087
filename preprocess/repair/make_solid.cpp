// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/make_solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/base/error.hpp"
#include "common/geometry/edge_table.hpp"
#include "common/geometry/mass_properties.hpp"
#include "preprocess/clean/drop_surroundings.hpp"
#include "preprocess/clean/find_parts.hpp"
#include "preprocess/clean/find_self_intersections.hpp"
#include "preprocess/clean/orient_faces.hpp"
#include "preprocess/clean/stitch_open_edges.hpp"
#include "preprocess/clean/weld.hpp"
#include "preprocess/measure/row_volumes.hpp"
#include "preprocess/repair/cap_texts.hpp"
#include "preprocess/repair/check_solid.hpp"
#include "preprocess/repair/close_surface.hpp"
#include "preprocess/repair/resolve_crossings.hpp"
#include "preprocess/repair/verify_solid.hpp"
#include "preprocess/repair/winding_solid.hpp"
#include "preprocess/repair/wrap_solid.hpp"

namespace ice {

namespace {

// Bounds between the rungs. Lower ones refuse meshes that are good enough, or climb to a rung that
// changes more of the mesh; higher ones accept a wrong volume. Shares are [-].
constexpr double kWindingDiffers = 0.02;  // of the volume: caps against the open surface
// Over a sheer line the surface where the winding number is a half sags between the ends: 3.7 % of
// the volume at a sheer of a quarter of the depth.
constexpr double kDeckDiffers = 0.05;
constexpr double kCapsMatter = 0.005;     // of the surface: below, caps need no second opinion
constexpr double kNoisy = 0.05;           // of the triangles: they cross their own part
constexpr std::size_t kNoisyCount = 100;  // at least: of a few large triangles all may cross
// Of the volume, by which a contoured surface may differ from the rows' sum. Larger accepts a
// contour that has lost thin parts.
constexpr double kContourError = 0.01;
constexpr double kVoid = 0.005;  // of the volume: voids that parts enclose together
// Diagonal over the offset of the wrap. Larger lays the wrap nearer to the surface, with more and
// smaller triangles, and takes longer.
constexpr double kWrapOffset = 1000.0;
// Diagonal over the least radius of the wrap's ball. Larger keeps smaller details and enters
// smaller openings.
constexpr double kWrapBall = 100.0;
// Radius of that ball over the widest opening's width: over a half, since it must not fall through.
// Larger rounds off more of the hull; at a half rounding decides whether it falls through.
constexpr double kOverOpening = 0.75;
constexpr std::size_t kMostPairs = 50000;  // pairs that are cut: 0.2 ms each, 10 s in all
// Of cutting: rounding may let cut pieces cross again. More cut on where each round leaves
// crossings, which the next rung resolves faster.
constexpr int kRounds = 3;
// Of the volume that the winding number gives: a wrap with less has gone in through an opening. A
// larger value refuses wraps of surfaces whose winding number is unsure, a smaller one accepts
// the plates alone.
constexpr double kCollapsed = 0.5;
// Rows per side of the box that measure the volume of the winding number, to which a solid is held
// with kContourError. Fewer make the error of sampling larger (measure_rows), more take time with
// their square.
constexpr int kVolumeRows = 300;

const char* const kRemedy =
    "close and orient it in the program that made it, then export again; or try --repair wrap";

using CrossingPairs = std::vector<std::pair<std::size_t, std::size_t>>;

// The rungs, from the one that changes least to the one that changes all. Each is tried on a copy
// and left where its result does not verify.
class Ladder {
public:
    Ladder(const std::string& name, const SolidOptions& options, Repairs& repairs,
           std::vector<std::string>& warnings)
        : name_(name), options_(options), repairs_(repairs), warnings_(warnings) {}

    TriangleMesh climb(TriangleMesh mesh) {
        const WeldCounts welded = weld(mesh);
        note("near vertices merged", welded.near_vertices);
        note("degenerate triangles dropped", welded.degenerate_triangles);
        note("duplicate triangles dropped", welded.duplicate_triangles);
        if (mesh.triangles.empty()) throw refusal("the volume is zero");
        leave_surroundings(mesh);
        if (options_.mode == RepairMode::strict) return demand(std::move(mesh), welded);
        open_edges_ = diagnose_edges(mesh).open_edges;
        if (open_edges_ > 0) stitch(mesh);
        if (options_.mode == RepairMode::wrap) return wrap(mesh);
        // parts that touch in edges, then openings, then crossings: each step needs the result of
        // the one before
        if (auto solid = unite_touching(mesh)) return flood(std::move(*solid));
        if (!diagnose_edges(mesh).closed()) mesh = close(std::move(mesh));
        return flood(untangle(std::move(mesh)));
    }

private:
    void note(const std::string& step, std::int64_t count) {
        if (count > 0) repairs_.emplace_back(step, count);
    }

    Error refusal(const std::string& fault, const std::string& remedy = kRemedy) const {
        return bad_input(name_, "is not the closed surface of a solid: " + fault, remedy);
    }

    // --repair strict
    TriangleMesh demand(TriangleMesh mesh, const WeldCounts& welded) {
        const SolidDiagnosis diagnosis = diagnose_solid(mesh);
        if (!diagnosis.closed() || diagnosis.intersecting_pairs > 0)
            throw refusal(diagnosis.text(), "mend it, or leave out --repair strict");
        if (welded.near_vertices > 0)
            throw refusal(fmt::format("{} vertices only nearly meet", welded.near_vertices),
                          "mend it, or leave out --repair strict");
        return choose(std::move(mesh));
    }

    void leave_surroundings(TriangleMesh& mesh) {
        const auto dropped = drop_surroundings(mesh);
        note("parts of a flow solver's domain dropped", static_cast<std::int64_t>(dropped.size()));
        for (const std::string& what : dropped) {
            if (options_.mode == RepairMode::strict)
                throw refusal(what, "leave it out of the file, or leave out --repair strict");
            warnings_.push_back(what + " was dropped: a flow solver's domain, not the ship");
        }
    }

    // Closed parts that share edges and faces: more than two triangles on an edge, but as many
    // that face one way as the other.
    std::optional<TriangleMesh> unite_touching(const TriangleMesh& mesh) {
        const auto edges = edge_table(mesh);
        const auto balanced = [](const MeshEdge& e) { return 2 * e.forwards == e.count; };
        if (!std::all_of(edges.begin(), edges.end(), balanced) ||
            std::all_of(edges.begin(), edges.end(), [](const MeshEdge& e) { return e.count == 2; }))
            return std::nullopt;
        TriangleMesh outward = mesh;
        if (measure_mass(mesh).volume < 0.0) flip(outward);
        return resolve(outward, find_self_intersections(outward), true);
    }

    void stitch(TriangleMesh& mesh) {
        const StitchCounts counts = stitch_open_edges(mesh);
        note(fmt::format("open edges stitched across cracks of up to {:.2g} m", counts.widest),
             counts.split);
        note("vertices merged across cracks", counts.merged);
    }

    // Openings capped, faces turned, half hulls mirrored.
    TriangleMesh close(TriangleMesh mesh) {
        ClosedSurface closed = close_surface(std::move(mesh), options_, repairs_);
        if (closed.mesh.triangles.empty()) throw refusal("the volume is zero");
        double caps = 0.0;
        for (const CapVerdict& cap : closed.caps) {
            if (cap.kind == CapKind::guess) throw too_large(cap, closed);
            caps += cap.area;
        }
        for (std::string& warning : cap_warnings(closed)) warnings_.push_back(std::move(warning));
        // Large caps are a guess at the missing surface. The winding number of the open surface is
        // another, independent one: both must enclose the same.
        if (caps > kCapsMatter * closed.surface) {
            const WindingComparison c = compare_windings(closed.open, closed.mesh);
            const bool deck =
                std::any_of(closed.caps.begin(), closed.caps.end(),
                            [](const CapVerdict& cap) { return cap.kind == CapKind::deck; });
            if (c.differs > (deck ? kDeckDiffers : kWindingDiffers))
                throw refusal(fmt::format(
                    "closing its openings gives {:.4g} m3, the winding number of the open surface "
                    "{:.4g} m3",
                    c.second_volume, c.first_volume));
        }
        return std::move(closed.mesh);
    }

    Error too_large(const CapVerdict& cap, const ClosedSurface& closed) const {
        const std::string fault =
            fmt::format("{} open edges; {}", open_edges_, fault_of(cap, closed));
        // The likeliest cause first: a file that may be damaged, patches that fit each other, an
        // opening that may be meant.
        if (!options_.suspect.empty())
            return refusal(fault + ", and " + options_.suspect, "export or copy the file again");
        if (const std::string cracks = fault_of_cracks(closed.open); !cracks.empty())
            return refusal(fmt::format("{} open edges; {}", open_edges_, cracks),
                           "sew the patches in the program that made them, or export it with finer "
                           "edges; or try --repair wrap");
        return refusal(fault,
                       "close it in the program that made it; if it is the open deck, give --up; "
                       "--repair wrap closes it whatever it is");
    }

    // A closed surface -> one that crosses itself nowhere, or without effect.
    TriangleMesh untangle(TriangleMesh mesh) {
        // From the method that changes least to the one that changes most: as it is, cut where it
        // crosses, crossings without effect left, the contour of the winding number, the wrap. Each
        // result is proved before it is taken.
        const CrossingPairs pairs = find_self_intersections(mesh);
        if (pairs.empty()) {
            TriangleMesh solid = choose(std::move(mesh));
            const SolidProof proof = verify_solid(solid);
            if (!proof.good) throw refusal(proof.fault);
            return solid;
        }
        turn_outward(mesh);
        if (auto solid = resolve(mesh, pairs)) return std::move(*solid);
        if (verify_solid(mesh).good) {
            note("crossing pairs of triangles left, without effect on the volume",
                 static_cast<std::int64_t>(pairs.size()));
            return choose(std::move(mesh));
        }
        if (auto solid = contour(mesh, "the mesh crosses itself")) return std::move(*solid);
        if (auto solid = wrap_last(mesh)) return std::move(*solid);
        throw refusal(fmt::format("{} pairs of triangles cross, the first at {}", pairs.size(),
                                  place(mesh.corner(pairs.front().first, 0))));
    }

    // Surfaces that face inwards are voids of the material, unless all of it is inside out.
    void turn_outward(TriangleMesh& mesh) {
        if (options_.kind == SolidKind::envelope) {
            note("inside-out surfaces turned over", turn_parts_outward(mesh));
        } else if (measure_mass(mesh).volume < 0.0) {
            flip(mesh);
            note("inside-out surfaces turned over", find_parts(mesh).count);
        }
    }

    // Cuts crossing triangles where they meet and drops the pieces inside; all else stays.
    std::optional<TriangleMesh> resolve(const TriangleMesh& mesh, const CrossingPairs& pairs,
                                        bool touching = false) {
        if (pairs.size() > kMostPairs) return std::nullopt;
        TriangleMesh solid = mesh;
        CrossingPairs left = pairs;
        for (int round = 0; round < kRounds && !left.empty(); ++round) {
            auto sum = resolve_crossings(solid, left);
            if (!sum) return std::nullopt;
            solid = std::move(*sum);
            left = find_self_intersections(solid);
        }
        const double expected = measure_rows(mesh, kVolumeRows)[0].by_winding;
        const ShellCounts shells = choose_shells(solid, options_.kind);
        const SolidProof proof = verify_solid(solid);
        // the envelope may have gained voids between the parts
        if (!proof.good || proof.volume < (1.0 - kContourError) * expected) return std::nullopt;
        if (touching)
            note("triangles at which parts touch joined", static_cast<std::int64_t>(pairs.size()));
        else
            say_resolved(mesh, pairs);
        note_shells(shells);
        note("crossing pairs of triangles left, without effect on the volume",
             static_cast<std::int64_t>(left.size()));
        return solid;
    }

    void say_resolved(const TriangleMesh& mesh, const CrossingPairs& pairs) {
        // Parts that overlap are usual in drawings of ships and only noted; a part that crosses
        // itself in many places is a scan or folded: a warning says so.
        const Parts parts = find_parts(mesh);
        std::set<std::int32_t> united;
        std::set<std::size_t> cut, own;
        for (const auto& [s, t] : pairs) {
            cut.insert({s, t});
            if (parts.of_triangle[s] != parts.of_triangle[t])
                united.insert({parts.of_triangle[s], parts.of_triangle[t]});
            else
                own.insert({s, t});
        }
        note("overlapping parts united", static_cast<std::int64_t>(united.size()));
        note("crossing triangles cut where they meet", static_cast<std::int64_t>(cut.size()));
        const double share =
            static_cast<double>(own.size()) / static_cast<double>(mesh.triangles.size());
        if (share > kNoisy && own.size() > kNoisyCount)
            warnings_.push_back(fmt::format(
                "{:.2g} % of the triangles cross others of their own part: the surface is noisy or "
                "folded, and only what it encloses once or more counts as solid",
                100.0 * share));
    }

    std::optional<TriangleMesh> contour(const TriangleMesh& mesh, const std::string& why) {
        WindingSolid solid = winding_solid(mesh, options_.kind, options_.radius);
        // Taken only where it can be trusted: the winding number is clear almost everywhere, the
        // result is a proved solid, and its volume is that of the winding number along rows of the
        // input; only an envelope, whose voids are filled, may have more.
        if (solid.unclear > kWindingDiffers || solid.mesh.triangles.empty()) return std::nullopt;
        const SolidProof proof = verify_solid(solid.mesh);
        const double expected = measure_rows(mesh, kVolumeRows)[0].by_winding;
        if (!proof.good || proof.volume < (1.0 - kContourError) * expected) return std::nullopt;
        if (options_.kind == SolidKind::material && proof.volume > (1.0 + kContourError) * expected)
            return std::nullopt;
        note("surface contoured anew from the winding number, triangles",
             static_cast<std::int64_t>(solid.mesh.triangles.size()));
        const auto [cut_off, at] = farthest_outside(mesh, solid.mesh);
        warnings_.push_back(fmt::format(
            "{}; its surface was contoured anew with cells of {:.3g} m: parts finer than that are "
            "rounded off, most at {}, by {:.3g} m",
            why, solid.cell, place(at), cut_off));
        return std::move(solid.mesh);
    }

    // The envelope's flood: parts that enclose a void together are filled, whatever gaps of less
    // than a hundredth of the length are between them.
    TriangleMesh flood(TriangleMesh solid) {
        // One part has no void between parts; a void of `material` is meant.
        if (options_.kind != SolidKind::envelope || find_parts(solid).count < 2) return solid;
        const EnclosedVoids voids = enclosed_voids(solid);
        const double volume = measure_mass(solid).volume;
        if (voids.volume < kVoid * volume) return solid;
        const std::string why = fmt::format(
            "voids of about {:.3g} m3 ({:.3g} % of the solid), to which gaps narrower than {:.2g} "
            "m "
            "lead, were filled",
            voids.volume, 100.0 * voids.volume / volume, voids.passage);
        if (auto filled = contour(solid, why)) return std::move(*filled);
        warnings_.push_back(fmt::format(
            "voids of about {:.3g} m3 ({:.3g} % of the solid) between its parts are not filled",
            voids.volume, 100.0 * voids.volume / volume));
        return solid;
    }

    // Last rung of `auto`: only where the winding number agrees.
    std::optional<TriangleMesh> wrap_last(const TriangleMesh& mesh) {
        const double alpha = diagonal(mesh) / kWrapBall;
        TriangleMesh wrapped = wrap_solid(mesh, alpha, diagonal(mesh) / kWrapOffset);
        if (!verify_solid(wrapped).good ||
            compare_windings(mesh, wrapped).differs > kWindingDiffers)
            return std::nullopt;
        say_wrapped(wrapped, alpha);
        return wrapped;
    }

    // --repair wrap
    TriangleMesh wrap(const TriangleMesh& mesh) {
        Repairs tried;  // on a copy, to learn the openings and which side is out
        const ClosedSurface closed = close_surface(mesh, options_, tried);
        if (closed.open.triangles.empty())
            throw refusal("the volume is zero", "export the surface of a body, not a flat sheet");
        // The ball of the shrink wrap must not fall through the widest opening that is no deck.
        const double alpha = std::max(diagonal(mesh) / kWrapBall, kOverOpening * closed.widest);
        TriangleMesh wrapped = wrap_solid(closed.unsure, alpha, diagonal(mesh) / kWrapOffset);
        const SolidProof proof = verify_solid(wrapped);
        if (!proof.good) throw refusal("shrink-wrapping fails: " + proof.fault);
        const WindingComparison c = compare_windings(closed.open, wrapped);
        // through an opening that is too wide the wrap would cover both sides of a shell and
        // enclose its plates only
        if (proof.volume < kCollapsed * c.first_volume)
            throw refusal(fmt::format("shrink-wrapping collapses to {:.4g} m3, where the winding "
                                      "number gives {:.4g} m3",
                                      proof.volume, c.first_volume),
                          "close its largest openings in the program that made it");
        if (std::any_of(tried.begin(), tried.end(), [](const auto& step) {
                return step.first == "half hull mirrored across y = 0";
            }))
            note("half hull mirrored across y = 0", 1);
        say_wrapped(wrapped, alpha);
        warnings_.push_back(fmt::format(
            "the shrink-wrapped volume is {:.4g} m3, that of the winding number {:.4g} m3 "
            "({:+.1f} %)",
            proof.volume, c.first_volume,
            100.0 * (proof.volume / std::max(c.first_volume, 1e-300) - 1.0)));
        return wrapped;
    }

    void say_wrapped(const TriangleMesh& wrapped, double alpha) {
        note("surface shrink-wrapped, triangles",
             static_cast<std::int64_t>(wrapped.triangles.size()));
        warnings_.push_back(fmt::format(
            "the surface was shrink-wrapped: openings and gaps narrower than {:.3g} m are closed, "
            "edges rounded off",
            2.0 * alpha));
    }

    TriangleMesh choose(TriangleMesh mesh) {
        const ShellCounts shells = choose_shells(mesh, options_.kind);
        if (mesh.triangles.empty()) throw refusal("the volume is zero");
        if (shells.flipped > 0 && options_.mode == RepairMode::strict)
            throw refusal("the surface is inside out",
                          "turn it over, or leave out --repair strict");
        note_shells(shells);
        return mesh;
    }

    void note_shells(const ShellCounts& shells) {
        note("inside-out surfaces turned over", shells.flipped);
        note(options_.kind == SolidKind::envelope ? "surfaces inside the envelope dropped"
                                                  : "surfaces inside the material dropped",
             shells.dropped);
        note("surfaces without volume dropped", shells.flat);
    }

    static double diagonal(const TriangleMesh& mesh) {
        Eigen::AlignedBox3d box;
        for (const Vec3& v : mesh.vertices) box.extend(v);
        return box.diagonal().norm();
    }

    const std::string& name_;
    const SolidOptions& options_;
    Repairs& repairs_;
    std::vector<std::string>& warnings_;
    std::int64_t open_edges_ = 0;  // of the mesh as it was read
};

}  // namespace

TriangleMesh make_solid(TriangleMesh mesh, const std::string& name, const SolidOptions& options,
                        Repairs& repairs, std::vector<std::string>* warnings) {
    std::vector<std::string> unread;
    return Ladder(name, options, repairs, warnings != nullptr ? *warnings : unread)
        .climb(std::move(mesh));
}

}  // namespace ice
