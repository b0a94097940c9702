// Arrays of an Hdf5File.
#include <algorithm>
#include <type_traits>
#include <utility>

#include "src/io/checksum.hpp"
#include "src/io/hdf5_file.hpp"
#include "src/io/hdf5_handle.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

using hdf5::Handle;
using hdf5::memory_type;

namespace {

constexpr const char* kChecksumName = "checksum";

ElementType element_type(hid_t type) {
  const auto size = H5Tget_size(type);
  const auto kind = H5Tget_class(type);
  if (kind == H5T_FLOAT && size == sizeof(float)) return ElementType::float32;
  if (kind == H5T_FLOAT && size == sizeof(double)) return ElementType::float64;
  const bool is_signed = kind == H5T_INTEGER && H5Tget_sign(type) == H5T_SGN_2;
  if (is_signed && size == sizeof(std::int32_t)) return ElementType::int32;
  if (is_signed && size == sizeof(std::int64_t)) return ElementType::int64;
  return ElementType::other;
}

/// Product of the extents; nothing if it does not fit into 64 bits.
bool count_elements(const Extents& extents, std::uint64_t& count) {
  count = 1;
  for (const auto extent : extents) {
    if (__builtin_mul_overflow(count, extent, &count)) return false;
  }
  return true;
}

Handle dataspace(const Extents& extents) {
  const std::vector<hsize_t> dims(extents.begin(), extents.end());
  return {H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose};
}

herr_t select_block(const Handle& space, const Extents& first, const Extents& size) {
  const std::vector<hsize_t> begin(first.begin(), first.end()), count(size.begin(), size.end());
  return H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, begin.data(), nullptr, count.data(),
                             nullptr);
}

Handle array_creation_list() {
  Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_fill_time(list.get(), H5D_FILL_TIME_NEVER);  // every element is written
  H5Pset_obj_track_times(list.get(), false);          // equal runs give equal files
  return list;
}

}  // namespace

template <class T>
void Hdf5File::put_checksum(const std::string& name, std::span<const T> values,
                            const Extents& extents, const Hyperslab& slab) {
  std::uint64_t sum = 0;  // of this rank's slab
  if (!slab.whole.empty()) {
    sum = checksum(values, extents, slab.whole, slab.first);
  } else if (is_root_) {
    sum = checksum(values, extents, extents, Extents(extents.size(), 0));
  }
  if (parallel_) MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_UINT64_T, MPI_SUM, communicator_);
  set_attribute(name, kChecksumName, static_cast<std::int64_t>(sum));
}

template <class T>
void Hdf5File::write(const std::string& name, std::span<const T> values, const Extents& extents,
                     std::string_view units, const Hyperslab& slab) {
  const Extents& whole = slab.whole.empty() ? extents : slab.whole;
  std::uint64_t count = 0, count_of_all = 0;
  count_elements(whole, count_of_all);
  if (extents.empty() || !count_elements(extents, count) || count != values.size()) {
    fail(std::to_string(values.size()) + " values do not fill " + to_string(extents), name);
  }
  if (const auto slash = name.rfind('/'); slash != std::string::npos)
    make_group(name.substr(0, slash));
  const auto [base, path] = locate(name);
  const Handle memory = dataspace(extents), file = dataspace(whole);
  const Handle creation = array_creation_list();
  const Handle array(check(H5Dcreate2(base, path.c_str(), memory_type<T>(), file.get(), H5P_DEFAULT,
                                      creation.get(), H5P_DEFAULT),
                           name),
                     H5Dclose);
  if (values.empty() || (slab.whole.empty() && !is_root_)) {
    check(H5Sselect_none(memory.get()), name);
    check(H5Sselect_none(file.get()), name);
  } else if (!slab.whole.empty()) {
    check(select_block(file, slab.first, extents), name);
  }
  const Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  if (parallel_) check(H5Pset_dxpl_mpio(transfer.get(), H5FD_MPIO_COLLECTIVE), name);
  // An array without elements is not allocated; the parallel driver fails to write it.
  if (count_of_all > 0) {
    check(H5Dwrite(array.get(), memory_type<T>(), memory.get(), file.get(), transfer.get(),
                   values.data()),
          name);
  }
  set_attribute(name, "units", units);
  if (mode_ != Mode::create_sealable) put_checksum(name, values, extents, slab);
  check_writes();  // no need to go on with a full disk
}

ArrayInfo Hdf5File::info(const std::string& name) const {
  if (!exists(name)) fail("it has no array \"" + name + "\"", {});
  const auto [base, path] = locate(name);
  const Handle array(check(H5Dopen2(base, path.c_str(), H5P_DEFAULT), name), H5Dclose);
  const Handle creation(check(H5Dget_create_plist(array.get()), name), H5Pclose);
  // Such an array may lead to itself, where the library would go round for ever.
  if (H5Pget_layout(creation.get()) == H5D_VIRTUAL || H5Pget_external_count(creation.get()) > 0) {
    fail("its values lie elsewhere, in other arrays or files", name);
  }
  const Handle space(check(H5Dget_space(array.get()), name), H5Sclose);
  const Handle type(check(H5Dget_type(array.get()), name), H5Tclose);
  const int rank = check(H5Sget_simple_extent_ndims(space.get()), name);
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  if (rank > 0) check(H5Sget_simple_extent_dims(space.get(), dims.data(), nullptr), name);

  ArrayInfo result{element_type(type.get()), Extents(dims.begin(), dims.end())};
  if (mode_ != Mode::read) return result;  // of ours, perhaps not on the disk yet
  // A damaged file must not make us ask for absurd amounts of memory: of what an array claims to
  // hold, this much must be there. Deflate (in files that others made) packs up to 1032 times.
  const std::uint64_t packed = H5Pget_nfilters(creation.get()) > 0 ? 1100 : 1;
  const std::uint64_t file_size = std::filesystem::file_size(path_);
  std::uint64_t count = 0;
  // Elements are counted first: the library itself fails with extents beyond 64 bits.
  if (!count_elements(result.extents, count) ||
      count / packed > std::min<std::uint64_t>(file_size, H5Dget_storage_size(array.get())) /
                           H5Tget_size(type.get())) {
    fail("it claims " + to_string(result.extents) + " elements, more than the file can hold", name);
  }
  return result;
}

template <class T>
std::vector<T> Hdf5File::read_as(const std::string& name, const ArrayInfo& found,
                                 const Extents& first, const Extents& size) const {
  const auto [base, path] = locate(name);
  const Handle array(check(H5Dopen2(base, path.c_str(), H5P_DEFAULT), name), H5Dclose);
  const Extents& part = first.empty() ? found.extents : size;
  std::uint64_t n = 0;
  count_elements(part, n);
  std::vector<T> values(n);
  if (n == 0) return values;
  const Handle file(check(H5Dget_space(array.get()), name), H5Sclose), memory = dataspace(part);
  if (part != found.extents) check(select_block(file, first, part), name);
  check(
      H5Dread(array.get(), memory_type<T>(), memory.get(), file.get(), H5P_DEFAULT, values.data()),
      name);
  const bool comparable = part == found.extents && found.type == element_type(memory_type<T>());
  if (!comparable || !has_attribute(name, kChecksumName)) return values;
  const auto sum = checksum<T>(values, part, part, Extents(part.size(), 0));
  if (attribute<std::int64_t>(name, kChecksumName) != static_cast<std::int64_t>(sum)) {
    fail(
        "it is damaged: its checksum is not that of what was written (whoever changes values on "
        "purpose deletes the attribute \"checksum\")",
        name);
  }
  return values;
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& name, const Extents& whole, const Extents& first,
                              const Extents& size) const {
  const ArrayInfo found = info(name);
  if (!whole.empty() && found.extents != whole) {
    fail("it is " + to_string(found.extents) + ", expected was " + to_string(whole), name);
  }
  const auto [base, path] = locate(name);
  const Handle array(check(H5Dopen2(base, path.c_str(), H5P_DEFAULT), name), H5Dclose);
  const Handle type(check(H5Dget_type(array.get()), name), H5Tclose);
  if (H5Tget_class(type.get()) != (std::is_integral_v<T> ? H5T_INTEGER : H5T_FLOAT)) {
    fail(std::is_integral_v<T> ? "it should hold integers" : "it should hold real numbers", name);
  }
  // Narrower numbers are widened only after their checksum was looked at.
  using Narrow = std::conditional_t<std::is_integral_v<T>, std::int32_t, float>;
  if (found.type != element_type(memory_type<Narrow>()))
    return read_as<T>(name, found, first, size);
  const auto narrow = read_as<Narrow>(name, found, first, size);
  return {narrow.begin(), narrow.end()};
}

#define BARCHAN_HDF5_ARRAYS(T)                                                               \
  template void Hdf5File::write(const std::string&, std::span<const T>, const Extents&,      \
                                std::string_view, const Hyperslab&);                         \
  template std::vector<T> Hdf5File::read(const std::string&, const Extents&, const Extents&, \
                                         const Extents&) const;
BARCHAN_HDF5_ARRAYS(float)
BARCHAN_HDF5_ARRAYS(double)
BARCHAN_HDF5_ARRAYS(std::int32_t)
BARCHAN_HDF5_ARRAYS(std::int64_t)
#undef BARCHAN_HDF5_ARRAYS

Hyperslab slab_of_entries(std::uint64_t n, MPI_Comm ranks) {
  if (rank_count(ranks) == 1) return {};
  std::uint64_t before = 0, all = 0;
  MPI_Exscan(&n, &before, 1, MPI_UINT64_T, MPI_SUM, ranks);
  MPI_Allreduce(&n, &all, 1, MPI_UINT64_T, MPI_SUM, ranks);
  return {.whole = {all}, .first = {rank_of(ranks) == 0 ? 0 : before}};
}

Hyperslab slab_of(const Hyperslab& rows, const Extents& extents, std::size_t dimension) {
  if (rows.whole.empty()) return {};
  Hyperslab slab{.whole = extents, .first = Extents(extents.size(), 0)};
  slab.whole[dimension] = rows.whole[0];
  slab.first[dimension] = rows.first[0];
  return slab;
}

}  // namespace barchan
