// SPDX-License-Identifier: GPL-3.0-or-later
// The file, its groups and attributes; hdf5_datasets.cpp has the datasets.
#include "common/formats/hdf5_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "common/base/error.hpp"
#include "common/formats/hdf5_handle.hpp"

namespace ice {

using detail::Handle;
using detail::to_hsize;

std::string Hdf5File::describe(const std::string& object) const {
    return path_.string() + ": " + object;
}

namespace {

// Settings of the whole library, made before any other call.
void set_up_library() {
    // HDF5 tidies up when the program ends, and crashes where the disk was full: it tries to write
    // the same data again. All files are closed by then, so that there is nothing to tidy up.
    static const herr_t untidy = H5dont_atexit();
    // By default HDF5 keeps up to 21 MB of freed memory for later files; a long run with
    // checkpoints reaches this bound. Memory that is kept here [bytes]: 1 MiB of each kind, 64 KiB
    // of each size. More wastes memory; with less HDF5 allocates again.
    constexpr int kOfKind = 1 << 20, kOfSize = 1 << 16;
    static const herr_t limited =
        H5set_free_list_limits(kOfKind, kOfSize, kOfKind, kOfSize, kOfKind, kOfSize);
    (void)untidy, (void)limited;
}

// The index of a file's chunks grows with a long run, and HDF5 keeps up to 32 MiB of it in memory.
// Bounds this to the 2 MiB with which HDF5 begins; it reads the rest of the index from the file.
void limit_metadata(hid_t access) {
    H5AC_cache_config_t config;
    config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
    if (H5Pget_mdc_config(access, &config) < 0) return;
    config.max_size = config.initial_size;
    H5Pset_mdc_config(access, &config);
}

}  // namespace

Hdf5File::Hdf5File(const std::filesystem::path& path, Mode mode) : path_(path) {
    set_up_library();
    detail::require_memory();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // our messages name the remedy, HDF5's do not
    H5PLset_loading_state(0);                     // no file may load code
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);

    H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V110);
    // without locks a running run can be read, and file systems without locks work
    H5Pset_file_locking(access, false, true);
    // Space in large pieces: the file's end, which is written last, seldom moves then. A kill
    // between a chunk of data and the end would leave the chunk outside of the file.
    if (mode == Mode::create_growing) H5Pset_small_data_block_size(access, 1 << 18);
    limit_metadata(access);
    if (mode == Mode::read) {
        if (!std::filesystem::exists(path))
            throw bad_input(path.string(), "file not found", "check the path");
        // HDF5 says of both faults that it cannot open the file
        if (::access(path.c_str(), R_OK) != 0)
            throw bad_input(path.string(), std::string("cannot be read: ") + std::strerror(errno),
                            "check its permissions");
        id_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
        if (id_ < 0)
            throw bad_input(path.string(), "is not an HDF5 file, or is truncated",
                            "make it again with the tool that wrote it");
        limit_reading(2000);
        return;
    }
    id_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    if (id_ < 0)
        throw run_failed(path.string(), "cannot be created",
                         "check that the folder exists, is writable and the disk is not full");
}

Hdf5File::~Hdf5File() {
    if (id_ >= 0) H5Fclose(id_);
}

void Hdf5File::close() {
    const herr_t status = H5Fclose(id_);
    id_ = -1;
    if (status < 0)
        throw run_failed(path_.string(), "cannot be completed", "check that the disk is not full");
}

void Hdf5File::flush() {
    detail::require_memory();
    if (H5Fflush(id_, H5F_SCOPE_GLOBAL) < 0)
        throw run_failed(path_.string(), "cannot be written", "check that the disk is not full");
}

// Variable length and UTF-8: any length fits, and h5py gives a str, not bytes.
void Hdf5File::write_attribute(const std::string& object, const std::string& name,
                               const std::string& text) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate_by_name(id_, object.c_str(), name.c_str(), type, space,
                                             H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    const char* pointer = text.c_str();
    if (attribute < 0 || H5Awrite(attribute, type, &pointer) < 0)
        throw run_failed(describe(object + " attribute " + name), "cannot be written",
                         "check that the disk is not full");
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name,
                               const std::vector<double>& values,
                               const std::vector<std::uint64_t>& shape) {
    const auto dims = to_hsize(shape);
    const Handle space(dims.empty()
                           ? H5Screate(H5S_SCALAR)
                           : H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr),
                       H5Sclose);
    const Handle attribute(H5Acreate_by_name(id_, object.c_str(), name.c_str(), H5T_IEEE_F64LE,
                                             space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    if (attribute < 0 || H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data()) < 0)
        throw run_failed(describe(object + " attribute " + name), "cannot be written",
                         "check that the disk is not full");
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name,
                               std::int64_t value) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    // little-endian in the file on every machine: equal runs give equal bytes
    const Handle attribute(H5Acreate_by_name(id_, object.c_str(), name.c_str(), H5T_STD_I64LE,
                                             space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    if (attribute < 0 || H5Awrite(attribute, H5T_NATIVE_INT64, &value) < 0)
        throw run_failed(describe(object + " attribute " + name), "cannot be written",
                         "check that the disk is not full");
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
    return has(object) && H5Aexists_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5File::read_text_attribute(const std::string& object,
                                          const std::string& name) const {
    const auto fail = [&] {
        return bad_input(describe(object + " attribute " + name), "is missing or not a text",
                         "make the file again with the tool that wrote it");
    };
    if (!has_attribute(object, name)) throw fail();
    const Handle attribute(
        H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    if (H5Tget_class(type) != H5T_STRING) throw fail();
    // variable length: HDF5 allocates the text, we release it
    if (H5Tis_variable_str(type) > 0) {
        char* text = nullptr;
        if (H5Aread(attribute, type, &text) < 0 || text == nullptr) throw fail();
        std::string result(text);
        H5free_memory(text);
        return result;
    }
    // Bytes of a text at most [bytes]: the longest text of a sound file is a case or a certificate,
    // some hundred kilobytes. A larger value lets a damaged width take more memory, a smaller one
    // refuses long cases.
    constexpr std::size_t kLongestText = 16u << 20;
    const std::size_t width = H5Tget_size(type);
    if (width > kLongestText) throw fail();
    std::string text(width, '\0');
    if (H5Aread(attribute, type, text.data()) < 0) throw fail();
    return text.substr(0, text.find('\0'));
}

std::vector<double> Hdf5File::read_number_attribute(const std::string& object,
                                                    const std::string& name) const {
    const auto fail = [&] {
        return bad_input(describe(object + " attribute " + name), "is missing or not a number",
                         "make the file again with the tool that wrote it");
    };
    if (!has_attribute(object, name)) throw fail();
    const Handle attribute(
        H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    // the longest attribute has nine numbers; 1000 bounds the memory for a damaged one
    if (count < 1 || count > 1000) throw fail();
    std::vector<double> values(static_cast<std::size_t>(count));
    if (H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()) < 0) throw fail();
    return values;
}

void Hdf5File::create_group(const std::string& name) {
    const Handle group(H5Gcreate2(id_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Gclose);
    if (group < 0)
        throw run_failed(describe(name), "cannot be created", "check that the disk is not full");
}

// Every step of the way must be a group or dataset of this file, no link to another place or file.
bool Hdf5File::has(const std::string& name) const {
    for (std::size_t end = 0; end < name.size();) {
        end = std::min(name.find('/', end + 1), name.size());
        const std::string part = name.substr(0, end);
        if (part == "/") continue;
        H5L_info_t link;
        if (H5Lexists(id_, part.c_str(), H5P_DEFAULT) <= 0) return false;
        if (H5Lget_info(id_, part.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
            throw bad_input(describe(part), "is a link to somewhere else",
                            "make the file again with the tool that wrote it");
    }
    return true;
}

void Hdf5File::limit_reading(std::uint64_t times) const {
    // [bytes]: small files may unpack to much more than their size, so 128 MiB are free for each.
    // Every machine that runs the programs has these; more would let a hostile file take it.
    constexpr std::uint64_t kFree = 128u << 20;
    left_ = kFree + times * std::filesystem::file_size(path_);
}

}  // namespace ice
