// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/gone_pieces.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "common/base/assert.hpp"
#include "common/base/error.hpp"

namespace ice {

namespace {

constexpr const char* kName = "pieces-gone-";

// Numbers of a piece in the file before its outline [-]. All are doubles: whole numbers up to 2^53
// fit. Rows of one kind alone, so that the file can be read without an index.
constexpr std::size_t kNumbers = 9;

}  // namespace

GonePieces::GonePieces(const GonePieces& other) {
    // A copy has a file of its own: both would otherwise write at the same place.
    if (!other.is_open()) return;
    open(other.folder_);
    std::vector<IcePiece> pieces;
    other.read(pieces);
    for (const IcePiece& piece : pieces) add(piece);
}

GonePieces& GonePieces::operator=(const GonePieces& other) {
    if (this != &other) *this = GonePieces(other);
    return *this;
}

void GonePieces::fail(const char* what) const {
    throw run_failed(folder_, std::string(what) + ": " + std::strerror(errno),
                     "make room there, or choose another folder");
}

void GonePieces::open(const std::filesystem::path& folder) {
    std::string path = (folder / kName).string();
    path.append(6, 'X');  // mkstemp puts a name there that no other run has
    const int number = mkstemp(path.data());
    std::unique_ptr<std::FILE, Close> file(number < 0 ? nullptr : fdopen(number, "w+b"));
    if (!file) {
        if (number >= 0) ::close(number);
        folder_ = folder.string();
        fail("a file of the pieces that are gone cannot be created there");
    }
    // The file has no name any more: it disappears with the program, however that ends.
    std::error_code ignored;  // then an empty name stays in the folder
    std::filesystem::remove(path, ignored);
    file_ = std::move(file);
    folder_ = folder.string();
    count_ = 0;
    bytes_ = 0;
}

void GonePieces::add(const IcePiece& piece) {
    ICE_ASSERT(is_open());
    // written at once: a full disk is reported in the step that lost a piece
    std::vector<double> row{static_cast<double>(piece.number),
                            static_cast<double>(piece.body),
                            piece.born,
                            piece.gone,
                            piece.load,
                            piece.radius,
                            piece.at.x(),
                            piece.at.y(),
                            static_cast<double>(piece.outline.size())};
    for (const Vec2& p : piece.outline) row.insert(row.end(), {p.x(), p.y()});
    if (std::fwrite(row.data(), sizeof(double), row.size(), file_.get()) != row.size() ||
        std::fflush(file_.get()) != 0)
        fail("the pieces that are gone cannot be written there");
    ++count_;
    bytes_ += sizeof(double) * row.size();
}

void GonePieces::read(std::vector<IcePiece>& out) const {
    if (!is_open() || count_ == 0) return;
    std::FILE* const file = file_.get();
    const auto take = [&](std::vector<double>& values) {
        if (std::fread(values.data(), sizeof(double), values.size(), file) != values.size())
            fail("the pieces that are gone cannot be read there");
    };
    std::rewind(file);
    std::vector<double> row(kNumbers), corners;
    for (std::int64_t k = 0; k < count_; ++k) {
        take(row);
        // the last number is that of the outline's corners
        corners.resize(2 * static_cast<std::size_t>(row[8]));
        take(corners);
        IcePiece piece{static_cast<std::int64_t>(row[0]),
                       static_cast<std::int32_t>(row[1]),
                       row[2],
                       row[3],
                       row[4],
                       row[5],
                       Vec2(row[6], row[7]),
                       {}};
        for (std::size_t c = 0; c < corners.size(); c += 2)
            piece.outline.emplace_back(corners[c], corners[c + 1]);
        out.push_back(std::move(piece));
    }
    // the next piece is appended
    std::fseek(file, 0, SEEK_END);
}

}  // namespace ice
