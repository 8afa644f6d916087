// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/make_solid.hpp"

#include "common/base/error.hpp"
#include "preprocess/clean/check_solid.hpp"
#include "preprocess/clean/weld.hpp"

namespace ice {

namespace {

Error refusal(const std::string& name, const std::string& fault) {
    return bad_input(name, "is not the closed surface of a solid: " + fault,
                     "close and orient it in the program that made it, then export again");
}

}  // namespace

TriangleMesh make_solid(TriangleMesh mesh, const std::string& name, const SolidOptions& options,
                        Repairs& repairs) {
    const auto note = [&](const char* step, std::int64_t count) {
        if (count > 0) repairs.emplace_back(step, count);
    };
    const WeldCounts welded = weld(mesh);
    note("near vertices merged", welded.near_vertices);
    note("degenerate triangles dropped", welded.degenerate_triangles);
    note("duplicate triangles dropped", welded.duplicate_triangles);

    const SolidDiagnosis diagnosis = diagnose_solid(mesh);
    if (!diagnosis.closed() || diagnosis.intersecting_pairs > 0)
        throw refusal(name, diagnosis.text());

    const ShellCounts shells = choose_shells(mesh, options.kind);
    if (mesh.triangles.empty()) throw refusal(name, "the volume is zero");
    if (shells.flipped > 0 && options.strict) throw refusal(name, "the surface is inside out");
    note("inside-out surfaces turned over", shells.flipped);
    note(options.kind == SolidKind::envelope ? "surfaces inside the envelope dropped"
                                             : "surfaces inside the material dropped",
         shells.dropped);
    note("surfaces without volume dropped", shells.flat);
    return mesh;
}

}  // namespace ice
