// SPDX-License-Identifier: GPL-3.0-or-later
// write_sample_run FILE [--killed]: writes a made-up run for open_run.py; killed: leaves FILE.part.
#include <string>

#include "tests/common/fixtures.hpp"

int main(int argc, char** argv) {
    if (argc < 2) return 2;
    const ice::RunData run = ice::test::make_run();
    if (argc == 2) {
        ice::test::write_run(argv[1], run);
        return 0;
    }
    ice::RunWriter writer(argv[1], run.header);
    ice::test::add_frames(writer, run, 45);
    _exit(0);
}
