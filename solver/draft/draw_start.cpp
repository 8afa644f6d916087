// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/draft/draw_start.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "common/base/error.hpp"
#include "common/cli/picture_file.hpp"
#include "common/cli/sibling_program.hpp"
#include "common/formats/pieces_file.hpp"
#include "solver/live_edge/edge_record.hpp"
#include "solver/record/recorder.hpp"

namespace ice {

namespace {

namespace fs = std::filesystem;

// mkdtemp() wants six of them at the end
const std::string kScratchName = "icesolve-" + std::string(6, 'X');

// A temporary folder, removed by the destructor.
class ScratchFolder {
public:
    ScratchFolder() {
        std::string name = (fs::temp_directory_path() / kScratchName).string();
        if (mkdtemp(name.data()) == nullptr)
            throw run_failed(name, "cannot be created", "check the temporary folder (TMPDIR)");
        path_ = name;
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

}  // namespace

void draw_start(const World& w, const fs::path& picture) {
    check_picture_name(picture);
    const ScratchFolder folder;
    // A run of no step: its folder has all that icepost needs to draw, and is removed afterwards.
    Recorder recorder(w.parameters, w.scene);
    recorder.open(folder.path(), "icesolve --check", w.scene);
    Summary unused;
    recorder.finish({w.scene, w.contacts, w.constraints, w.ledger, 0.0, true}, unused);
    // the recorder would write it, too, but also report on the pieces that broke
    if (w.edge.has_sheet()) write_pieces(folder.path() / kPiecesName, record_edge(w.edge));
    const auto code = run_sibling("icepost", {"-q", "view", folder.path().string(), "--time", "0",
                                              "--from", "side", "-o", picture.string()});
    if (code != 0)
        throw run_failed(picture.string(),
                         code ? fmt::format("not drawn: icepost ended with code {}", *code)
                              : std::string("not drawn: icepost does not lie beside icesolve"),
                         "build or install icepost");
}

}  // namespace ice
