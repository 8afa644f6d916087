// SPDX-License-Identifier: GPL-3.0-or-later
// iceflow as a user meets it.
//
// Tolerances: 1 % of a volume is the wetted hull cut and simplified; 5 % of a residual and 0.5 % of
// a flux are where iceflow warns (solver/flow/flow_table.cpp), 1 % is a smooth hull's residual.
#include <fmt/format.h>

#include "common/formats/flow_file.hpp"
#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

TEST_CASE("iceflow makes a table, a report and a picture's data of a hull", "[cli][flow]") {
    const Workshop w;
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-hull-3d.obj -r 0.2 --mode surface -q "
                  "-o hull.spheres.h5")
                .code == 0);
    const Result r = w.run(
        "iceflow hull.spheres.h5 --panel \"80 cm\" --spacing 0.3 --json flow.json "
        "--export vti");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    CHECK_THAT(r.out, Catch::Contains("hull.flow.h5\n") && Catch::Contains("symmetric"));
    const FlowTable table = read_flow(w / "hull.flow.h5");
    CHECK(table.symmetric);
    CHECK(table.spacing == 0.3);
    CHECK(table.draught == Near(1.44));
    CHECK(table.residual < tolerance(0.05));
    CHECK_THAT(table.command_line, Catch::Contains("--spacing 0.3"));
    CHECK_THAT(table.created_by, Catch::StartsWith("iceflow "));
    const auto json = read_json_numbers(w / "flow.json");
    CHECK(json.at("panels") == double(table.panels));
    CHECK(json.at("residual") == table.residual);
    CHECK(std::abs(json.at("net_flux")) < tolerance(5e-3));
    const std::string vti = slurp(w / "hull.flow.vti");
    CHECK_THAT(vti, Catch::Contains("ImageData") && Catch::Contains("Name=\"velocity\""));
    // both sides: nodes of 4 numbers of 4 bytes
    const auto nodes =
        static_cast<std::size_t>(table.nodes[0] * (2 * table.nodes[1] - 1) * table.nodes[2]);
    CHECK(vti.size() > 16 * nodes);
    CHECK(vti.size() < 16 * nodes + 2000);

    const Result check = w.run("iceflow hull.spheres.h5 --draught 1.2 --check --panel 0.8");
    CHECK(check.code == 0);
    CHECK_THAT(check.out, Catch::Contains("draught 1.2 m") && !Catch::Contains("nodes"));
}

TEST_CASE("iceflow says a hull's added mass, and leaves little of the flow to pass through hulls",
          "[cli][flow]") {
    const Workshop w;
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-hull-3d.obj -r 0.2 --mode surface -q "
                  "-o hull.spheres.h5")
                .code == 0);
    const Result r =
        w.run("iceflow hull.spheres.h5 --check --added-mass --panel 0.8 --json a.json");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    const auto json = read_json_numbers(w / "a.json");
    const auto share = [&](const char* key) {
        return fmt::format("{:.3f}", json.at(std::string("added_mass.matrix.") + key) /
                                         json.at("added_mass.displacement_kg"));
    };
    CHECK_THAT(r.out, Catch::Contains("added mass        surge " + share("0.0") + ", sway " +
                                      share("1.1") + ", heave " + share("2.2") + " of"));
    // the wetted hull has 20.21 m3 (meshes/README.md gives the whole)
    CHECK(json.at("added_mass.displacement_kg") == Near(1025.0 * 20.21).epsilon(0.01));
    const auto of = [&](const char* key) {
        return json.at(std::string("added_mass.matrix.") + key) /
               json.at("added_mass.displacement_kg");
    };
    // a ship of 10 x 2 x 1.44 m moves less water along than across
    CHECK(of("0.0") < 0.2);
    CHECK(of("1.1") > 3.0 * of("0.0"));
    CHECK(json.at("added_mass.matrix.1.5") == json.at("added_mass.matrix.5.1"));
    CHECK(json.at("residual") < tolerance(0.05));  // a hull with sharp edges
    CHECK(std::abs(json.at("net_flux")) < tolerance(0.005));
    // a smooth one leaves 1 % or less
    REQUIRE(w.run("spherize " ICE_MESHES "/icebreaker-100m.obj -r 1.5 --mode surface -q "
                  "-o smooth.spheres.h5")
                .code == 0);
    REQUIRE(w.run("iceflow smooth.spheres.h5 --check --json b.json").code == 0);
    CHECK(read_json_numbers(w / "b.json").at("residual") < tolerance(0.01));
    CHECK(std::abs(read_json_numbers(w / "b.json").at("net_flux")) < tolerance(0.005));
    const Result flat = w.run("iceflow hull.spheres.h5 --added-mass --check --density 0");
    CHECK(flat.code == 2);
}

TEST_CASE("iceflow refuses with exit code 2 and leaves nothing behind", "[cli][flow][errors]") {
    const Workshop w;
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-floe-3d.obj -r 0.1 -s 0.2 -q -o box.h5").code ==
            0);
    const auto before = w.files();
    const auto refuses = w.refusing("iceflow ");
    refuses("", "no hull given");
    refuses("lost.h5", "lost.h5");
    refuses("lost.obj", "lost.obj: file not found");
    refuses(ICE_MESHES "/paper-hull-3d.obj", "paper-hull-3d.obj: is a mesh, not a sphere set");
    refuses("box.h5 --draught 0", "--draught");
    refuses("box.h5 --draught 9", "does not cut the hull");
    refuses("box.h5 --draught 0.2 --panel 1e-4", "allow longer edges");
    refuses("box.h5 --draught 0.2 --spacing 1e-4", "give a larger one");
    refuses("box.h5 -o box.h5", "--output: would overwrite the hull");
    refuses("box.h5 --export stl", "stl");
    // one name for each --without: the hull's follows
    refuses("--check --draught 0.2 --without nobody box.h5", "nobody");
    REQUIRE(
        w.run("spherize " ICE_MESHES "/paper-hull-2d.obj --slice y=0 -r 0.2 -q -o flat.h5").code ==
        0);
    refuses("flat.h5 --check --added-mass", "needs a hull in 3D");
    fs::remove(w / "flat.h5");
    CHECK(w.files() == before);
    const Result disk = w.run("iceflow box.h5 -o no/such/folder/x.h5");
    CHECK(disk.code == 1);
}

namespace {

// What --check says of the case's water. @param flow  the file made for the case's hull
void check_refused_flows(const Workshop& w, const std::string& flow) {
    const auto says = [&](const std::string& words, int code, const std::string& what) {
        const Result r = w.run("icesolve case.cfg --check " + words);
        CAPTURE(words, r.err);
        CHECK(r.code == code);
        CHECK_THAT(r.err, Catch::Contains(what));
    };
    says("--set hull.speed=3", 0, "Froude number of 0.31");
    says("--set flow.model=file", 2, "needs flow.file");
    says("--set flow.file=" + flow, 2, "only flow.model = \"file\" takes it");
    says("--set flow.model=file --set flow.file=" + flow + " --set hull.draught=1.2", 2,
         "is for a draught of 1.44 m");
    says("--set flow.model=file --set flow.file=floe.h5", 2,
         "is a sphere set, made by spherize, not a flow");
    says("--set flow.added_mass=computed --set simulation.dimension=2", 2, "in 3D only");
}

}  // namespace

TEST_CASE("a case takes the flow around its hull, made once, and warns of waves", "[cli][flow]") {
    const Workshop w;
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-hull-3d.obj -r 0.2 --mode surface -q "
                  "-o hull.spheres.h5")
                .code == 0);
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-floe-3d.obj -r 0.1 -s 0.2 -q -o floe.h5").code ==
            0);
    w.write("case.cfg",
            "[simulation]\nduration = 0.5\ntime_step = 0.01\n[hull]\n"
            "spheres = \"hull.spheres.h5\"\nposition = [-9.6, 0, 0]\nspeed = 0.5\n"
            "[[floes]]\nspheres = \"floe.h5\"\ncount = [2, 3]\nhold = \"never\"\n");
    const auto hash = [&](const std::string& words) {
        const Result r =
            w.run("icesolve case.cfg --out run --overwrite --no-report --hash-every 50 " + words);
        CAPTURE(words, r.err);
        CHECK(r.code == 0);
        return r.out;
    };
    // a ship at rest has no flow made, and the bits of water at rest
    const std::string none = "--set flow.model=none ";
    const std::string still = hash(none);
    CHECK(hash("--set hull.speed=0") == hash(none + "--set hull.speed=0"));
    CHECK(hash("--set hull.speed=0.1 --set flow.current=[0.1,0]") ==
          hash(none + "--set hull.speed=0.1 --set flow.current=[0.1,0]"));
    const auto without = w.files();
    CHECK(std::none_of(without.begin(), without.end(),
                       [](const std::string& name) { return name.ends_with(".flow.h5"); }));
    // of two runs at once one makes it, and the other takes that
    const std::string run = ICE_BIN "/icesolve case.cfg --no-report --out ";
    const Result both = w.run("icesolve --version >version.txt; (" + run + "one 2>one.txt & " +
                              run + "two 2>two.txt; wait); cat one.txt two.txt");
    const std::string made = "computing the flow around the hull";
    const auto first = both.out.find(made);
    CAPTURE(both.out);
    CHECK(first != std::string::npos);
    CHECK(both.out.find(made, first + 1) == std::string::npos);
    const std::string flow = hash("");
    CHECK(still != flow);
    CHECK(slurp(w / "one/forces.csv") == slurp(w / "two/forces.csv"));
    const auto files = w.files();
    CHECK(std::none_of(files.begin(), files.end(),
                       [](const std::string& name) { return name.ends_with(".lock"); }));
    const auto kept = std::find_if(files.begin(), files.end(), [](const std::string& name) {
        return name.starts_with("hull.") && name.ends_with(".flow.h5");
    });
    REQUIRE(kept != files.end());
    CHECK(16 * read_flow(w / *kept).size() < 8000000);  // in memory: it is to stay in the cache
    CHECK(hash("--threads 1 --simd scalar") == flow);
    CHECK(hash("--set flow.model=file --set flow.file=" + *kept) == flow);
    CHECK(hash(none + "--set flow.current=[0.1,0]") != still);
    hash("--set flow.added_mass=computed --verify");
    hash("");
    CHECK(read_json_numbers(w / "run" / "summary.json").contains("energy.water_work_J"));
    check_refused_flows(w, *kept);
}
