// SPDX-License-Identifier: GPL-3.0-or-later
// The datasets of Hdf5File: whole, in part, growing, and their labels.
#include <hdf5_hl.h>

#include <algorithm>
#include <limits>

#include "common/base/assert.hpp"
#include "common/base/error.hpp"
#include "common/formats/hdf5_file.hpp"
#include "common/formats/hdf5_handle.hpp"

namespace ice {

using detail::Handle;
using detail::to_hsize;

namespace {

// Compressed chunks wait in memory until the dataset is closed, where nothing would report that the
// disk is full.
bool reaches_file(hid_t dataset) { return H5Dflush(dataset) >= 0; }

template <class T>
hid_t memory_type();
template <>
hid_t memory_type<double>() {
    return H5T_NATIVE_DOUBLE;
}
template <>
hid_t memory_type<float>() {
    return H5T_NATIVE_FLOAT;
}
template <>
hid_t memory_type<std::int64_t>() {
    return H5T_NATIVE_INT64;
}
template <>
hid_t memory_type<std::int32_t>() {
    return H5T_NATIVE_INT32;
}
template <>
hid_t memory_type<std::uint8_t>() {
    return H5T_NATIVE_UINT8;
}

// Sizes read from a file are not trusted: a product that does not fit is the largest number.
std::uint64_t product(const std::vector<std::uint64_t>& shape) {
    std::uint64_t all = 1;
    for (const std::uint64_t n : shape)
        if (__builtin_mul_overflow(all, n, &all)) return std::numeric_limits<std::uint64_t>::max();
    return all;
}

constexpr const char* kRemake = "make the file again with the tool that wrote it";

}  // namespace

void Hdf5File::take_from_limit(const std::string& name, std::uint64_t count,
                               std::uint64_t width) const {
    std::uint64_t bytes = 0;
    if (__builtin_mul_overflow(count, width, &bytes) || bytes > left_)
        throw bad_input(describe(name), "claims more values than the file holds", kRemake);
    left_ -= bytes;
}

std::int64_t Hdf5File::open_dataset(const std::string& name) const {
    if (!has(name)) throw bad_input(describe(name), "is missing", kRemake);
    const hid_t dataset = H5Dopen2(id_, name.c_str(), H5P_DEFAULT);
    if (dataset < 0) throw bad_input(describe(name), "is not a dataset", kRemake);
    // values in another file, or mapped from one, could name any file of the reader's
    const Handle properties(H5Dget_create_plist(dataset), H5Pclose);
    if (properties < 0 || H5Pget_external_count(properties) != 0 ||
        H5Pget_layout(properties) == H5D_VIRTUAL) {
        H5Dclose(dataset);
        throw bad_input(describe(name), "has its values in another file", kRemake);
    }
    return dataset;
}

template <class T>
void Hdf5File::write(const std::string& name, const T* data,
                     const std::vector<std::uint64_t>& shape) {
    const auto dims = to_hsize(shape);
    const Handle space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr),
                       H5Sclose);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties, false);  // equal content, equal bytes
    const Handle dataset(H5Dcreate2(id_, name.c_str(), memory_type<T>(), space, H5P_DEFAULT,
                                    properties, H5P_DEFAULT),
                         H5Dclose);
    const bool empty = product(shape) == 0;
    if (dataset < 0 ||
        (!empty && H5Dwrite(dataset, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) ||
        !reaches_file(dataset))
        throw run_failed(describe(name), "cannot be written", "check that the disk is not full");
}

template <class T>
void Hdf5File::write_rows(const std::string& name, const T* rows,
                          const std::vector<std::uint64_t>& shape, std::uint64_t count, T rest) {
    if (count == shape[0]) return write(name, rows, shape);
    // Rows of a chunk [-], 256 kB for one double each. Smaller chunks cost an entry each in the
    // file's index; larger ones store more rows of fill values beside the last row written.
    constexpr hsize_t kRowsPerChunk = 1 << 15;
    // chunks, so that rows that were never written take no room: they read as `rest`
    auto dims = to_hsize(shape), chunk = dims, block = dims;
    chunk[0] = std::min(dims[0], kRowsPerChunk);
    block[0] = count;
    const std::vector<hsize_t> start(dims.size(), 0);
    const auto rank = static_cast<int>(dims.size());
    const Handle space(H5Screate_simple(rank, dims.data(), nullptr), H5Sclose);
    const Handle memory(H5Screate_simple(rank, block.data(), nullptr), H5Sclose);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(properties, rank, chunk.data());
    H5Pset_fill_value(properties, memory_type<T>(), &rest);
    H5Pset_obj_track_times(properties, false);
    const Handle dataset(H5Dcreate2(id_, name.c_str(), memory_type<T>(), space, H5P_DEFAULT,
                                    properties, H5P_DEFAULT),
                         H5Dclose);
    bool good = dataset >= 0;
    if (good && count > 0) {
        H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr);
        good = H5Dwrite(dataset, memory_type<T>(), memory, space, H5P_DEFAULT, rows) >= 0;
    }
    if (!good || !reaches_file(dataset))
        throw run_failed(describe(name), "cannot be written", "check that the disk is not full");
}

void Hdf5File::write_strings(const std::string& name, const std::vector<std::string>& texts) {
    // Fixed width, the longest text's: variable strings lie in a heap of the file, which HDF5 reads
    // without the bounds that read_strings() checks here.
    std::size_t width = 1;
    for (const std::string& text : texts) width = std::max(width, text.size());
    std::vector<char> packed(width * texts.size(), '\0');
    for (std::size_t k = 0; k < texts.size(); ++k)
        std::copy(texts[k].begin(), texts[k].end(),
                  packed.begin() + static_cast<std::ptrdiff_t>(k * width));
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, width);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const hsize_t count = texts.size();
    const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties, false);
    const Handle dataset(
        H5Dcreate2(id_, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
    if (dataset < 0 || H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.data()) < 0 ||
        !reaches_file(dataset))
        throw run_failed(describe(name), "cannot be written", "check that the disk is not full");
}

std::vector<std::uint64_t> Hdf5File::shape(const std::string& name) const {
    const Handle dataset(open_dataset(name), H5Dclose);
    const Handle space(H5Dget_space(dataset), H5Sclose);
    const int rank = space < 0 ? -1 : H5Sget_simple_extent_ndims(space);
    if (rank < 0) throw bad_input(describe(name), "is not a dataset", kRemake);
    std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    return {dims.begin(), dims.end()};
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& name) const {
    const std::uint64_t count = product(shape(name));
    // Before any memory is taken: a few bytes of a compressed file can claim terabytes.
    take_from_limit(name, count, sizeof(T));
    const Handle dataset(open_dataset(name), H5Dclose);
    const Handle type(H5Dget_type(dataset), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type);
    std::vector<T> values(count);
    const bool numeric = kind == H5T_INTEGER || kind == H5T_FLOAT;
    if (!numeric || (count > 0 && H5Dread(dataset, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                          values.data()) < 0))
        throw bad_input(describe(name), "cannot be read as numbers", kRemake);
    return values;
}

template <class T>
std::vector<T> Hdf5File::read_rows(const std::string& name, std::uint64_t first,
                                   std::uint64_t count) const {
    // Only the rows that are needed come into memory: a long run's histories may not fit.
    // Their size counts against the file's limit before it is reserved.
    std::vector<hsize_t> block = to_hsize(shape(name)), start(block.size(), 0);
    ICE_ASSERT(first + count <= block.at(0));
    start.at(0) = first;
    block[0] = count;
    take_from_limit(name, product({block.begin(), block.end()}), sizeof(T));
    const Handle dataset(open_dataset(name), H5Dclose);
    const Handle file_space(H5Dget_space(dataset), H5Sclose);
    const Handle memory(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr),
                        H5Sclose);
    std::vector<T> values(product({block.begin(), block.end()}));
    if (!values.empty() &&
        (H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, block.data(),
                             nullptr) < 0 ||
         H5Dread(dataset, memory_type<T>(), memory, file_space, H5P_DEFAULT, values.data()) < 0))
        throw bad_input(describe(name), "cannot be read as numbers", kRemake);
    return values;
}

std::vector<std::string> Hdf5File::read_strings(const std::string& name) const {
    const std::uint64_t count = product(shape(name));
    const Handle dataset(open_dataset(name), H5Dclose);
    const Handle type(H5Dget_type(dataset), H5Tclose);
    const std::size_t width = H5Tget_size(type);
    // Texts of fixed width alone, as the project's programs write them: their size is known before
    // memory is taken for them.
    const auto fail = [&] { return bad_input(describe(name), "is not a list of texts", kRemake); };
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || width == 0 ||
        count > 100000 || width > 10000)
        throw fail();
    take_from_limit(name, count, width);
    std::vector<char> packed(count * width);
    if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.data()) < 0) throw fail();
    std::vector<std::string> texts(count);
    for (std::size_t k = 0; k < count; ++k) {
        const auto begin = packed.begin() + static_cast<std::ptrdiff_t>(k * width);
        // a text ends at its first zero, or fills its width
        texts[k].assign(begin, std::find(begin, begin + static_cast<std::ptrdiff_t>(width), '\0'));
    }
    return texts;
}

template <class T>
void Hdf5File::create_appendable(const std::string& name,
                                 const std::vector<std::uint64_t>& row_shape,
                                 std::uint64_t rows_per_chunk) {
    std::vector<hsize_t> now{0}, most{H5S_UNLIMITED}, chunk{std::max<hsize_t>(1, rows_per_chunk)};
    for (const std::uint64_t n : row_shape) {
        now.push_back(n);
        most.push_back(n == 0 ? H5S_UNLIMITED : n);  // a chunk may not exceed a fixed size
        chunk.push_back(std::max<hsize_t>(1, n));
    }
    const Handle space(H5Screate_simple(static_cast<int>(now.size()), now.data(), most.data()),
                       H5Sclose);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
    // Bytes of equal weight side by side: the leading bytes of neighbouring rows are mostly equal,
    // and compress to little.
    H5Pset_shuffle(properties);
    H5Pset_deflate(properties, 4);
    H5Pset_obj_track_times(properties, false);
    const Handle dataset(H5Dcreate2(id_, name.c_str(), memory_type<T>(), space, H5P_DEFAULT,
                                    properties, H5P_DEFAULT),
                         H5Dclose);
    if (dataset < 0)
        throw run_failed(describe(name), "cannot be created", "check that the disk is not full");
}

template <class T>
void Hdf5File::append(const std::string& name, const T* rows, std::uint64_t count) {
    if (count == 0) return;
    std::vector<std::uint64_t> old = shape(name);
    // Closed, not flushed: the rows go to the file, which counts them at flush(), those of all
    // datasets together. Flushed one by one, a kill while the next one is compressed would leave
    // datasets of unlike length.
    Handle dataset(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
    std::vector<hsize_t> size = to_hsize(old), start(old.size(), 0), block = size;
    start[0] = size[0];
    block[0] = count;
    size[0] += count;
    // The dataset first, then the rows into its new end.
    const bool grown = H5Dset_extent(dataset, size.data()) >= 0;
    const Handle file_space(H5Dget_space(dataset), H5Sclose);
    H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr);
    const Handle memory_space(
        H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr), H5Sclose);
    const bool empty = std::find(block.begin(), block.end(), hsize_t{0}) != block.end();
    if (!grown ||
        (!empty &&
         H5Dwrite(dataset, memory_type<T>(), memory_space, file_space, H5P_DEFAULT, rows) < 0) ||
        !dataset.close())
        throw run_failed(describe(name), "cannot be written", "check that the disk is not full");
}

void Hdf5File::make_scale(const std::string& name) {
    const Handle dataset(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (dataset < 0 || H5DSset_scale(dataset, name.substr(name.rfind('/') + 1).c_str()) < 0)
        throw run_failed(describe(name), "cannot be made a dimension scale",
                         "check that the disk is not full");
}

void Hdf5File::attach_scale(const std::string& dataset, unsigned dimension,
                            const std::string& scale) {
    const Handle data(H5Dopen2(id_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle axis(H5Dopen2(id_, scale.c_str(), H5P_DEFAULT), H5Dclose);
    if (data < 0 || axis < 0 || H5DSattach_scale(data, axis, dimension) < 0)
        throw run_failed(describe(dataset), "cannot be labelled with " + scale,
                         "check that the disk is not full");
}

#define ICE_INSTANTIATE(T)                                                                      \
    template void Hdf5File::write<T>(const std::string&, const T*,                              \
                                     const std::vector<std::uint64_t>&);                        \
    template void Hdf5File::write_rows<T>(const std::string&, const T*,                         \
                                          const std::vector<std::uint64_t>&, std::uint64_t, T); \
    template std::vector<T> Hdf5File::read<T>(const std::string&) const;                        \
    template std::vector<T> Hdf5File::read_rows<T>(const std::string&, std::uint64_t,           \
                                                   std::uint64_t) const;                        \
    template void Hdf5File::create_appendable<T>(                                               \
        const std::string&, const std::vector<std::uint64_t>&, std::uint64_t);                  \
    template void Hdf5File::append<T>(const std::string&, const T*, std::uint64_t);

ICE_INSTANTIATE(double)
ICE_INSTANTIATE(float)
ICE_INSTANTIATE(std::int64_t)
ICE_INSTANTIATE(std::int32_t)
ICE_INSTANTIATE(std::uint8_t)
#undef ICE_INSTANTIATE

}  // namespace ice
