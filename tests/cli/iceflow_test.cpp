// SPDX-License-Identifier: GPL-3.0-or-later
// iceflow as a user meets it.
#include "common/formats/flow_file.hpp"
#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"

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
    CHECK(table.draught == Approx(1.44));
    CHECK(table.residual < 0.05);
    CHECK_THAT(table.command_line, Catch::Contains("--spacing 0.3"));
    CHECK_THAT(table.created_by, Catch::StartsWith("iceflow "));
    const auto json = read_json_numbers(w / "flow.json");
    CHECK(json.at("panels") == double(table.panels));
    CHECK(json.at("residual") == table.residual);
    CHECK(std::abs(json.at("net_flux")) < 5e-3);
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

TEST_CASE("iceflow refuses with exit code 2 and leaves nothing behind", "[cli][flow][errors]") {
    const Workshop w;
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-floe-3d.obj -r 0.1 -s 0.2 -q -o box.h5").code ==
            0);
    const auto before = w.files();
    const auto refuses = [&](const std::string& arguments, const std::string& words) {
        const Result r = w.run("iceflow " + arguments);
        CAPTURE(arguments, r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, Catch::Contains(words));
    };
    refuses("", "no hull given");
    refuses("lost.h5", "lost.h5");
    refuses("box.h5 --draught 0", "--draught");
    refuses("box.h5 --draught 9", "does not cut the hull");
    refuses("box.h5 --draught 0.2 --panel 1e-4", "allow longer edges");
    refuses("box.h5 --draught 0.2 --spacing 1e-4", "give a larger one");
    refuses("box.h5 -o box.h5", "--output: would overwrite the hull");
    refuses("box.h5 --export stl", "stl");
    CHECK(w.files() == before);
    const Result disk = w.run("iceflow box.h5 -o no/such/folder/x.h5");
    CHECK(disk.code == 1);
}
