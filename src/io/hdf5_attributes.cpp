// Attributes of an Hdf5File.
#include <array>
#include <type_traits>
#include <utility>

#include "src/io/hdf5_file.hpp"
#include "src/io/hdf5_handle.hpp"

namespace barchan {

using hdf5::Handle;
using hdf5::memory_type;

namespace {

/// Text of variable length, which Python reads as str.
Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

}  // namespace

void Hdf5File::put_attribute(const std::string& object, const std::string& name, Id type,
                             const void* value) {
  const std::string label = object + "@" + name;
  const auto [base, path] = locate(object);
  if (has_attribute(object, name)) {
    check(H5Adelete_by_name(base, path.c_str(), name.c_str(), H5P_DEFAULT), label);
  }
  const Handle space(check(H5Screate(H5S_SCALAR), label), H5Sclose);
  const Handle attribute(
      check(H5Acreate_by_name(base, path.c_str(), name.c_str(), type, space.get(), H5P_DEFAULT,
                              H5P_DEFAULT, H5P_DEFAULT),
            label),
      H5Aclose);
  check(H5Awrite(attribute.get(), type, value), label);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
  put_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             std::int64_t value) {
  put_attribute(object, name, H5T_NATIVE_INT64, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             std::string_view value) {
  const std::string terminated(value);
  const char* text = terminated.c_str();
  put_attribute(object, name, text_type().get(), static_cast<const void*>(&text));
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  const auto [base, path] = locate(object);
  return check(H5Aexists_by_name(base, path.c_str(), name.c_str(), H5P_DEFAULT),
               object + "@" + name) > 0;
}

template <class T>
T Hdf5File::attribute(const std::string& object, const std::string& name) const {
  constexpr bool is_text = std::is_same_v<T, std::string>;
  constexpr auto kind = is_text ? H5T_STRING : std::is_integral_v<T> ? H5T_INTEGER : H5T_FLOAT;
  const std::string label = object + "@" + name;
  if (!exists(object) || !has_attribute(object, name)) {
    fail("it has no attribute \"" + name + "\" at \"" + object + "\"", {});
  }
  const auto [base, path] = locate(object);
  const Handle attribute(
      check(H5Aopen_by_name(base, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), label),
      H5Aclose);
  const Handle stored(check(H5Aget_type(attribute.get()), label), H5Tclose);
  const Handle space(check(H5Aget_space(attribute.get()), label), H5Sclose);
  if (H5Tget_class(stored.get()) != kind || H5Sget_simple_extent_npoints(space.get()) != 1) {
    fail("the attribute \"" + name + "\" is of another type", object);
  }
  if constexpr (is_text) {
    if (H5Tis_variable_str(stored.get()) <= 0)
      fail("the attribute \"" + name + "\" is a text of fixed length", object);
    char* text = nullptr;
    check(H5Aread(attribute.get(), text_type().get(), static_cast<void*>(&text)), label);
    std::string result(text == nullptr ? "" : text);
    H5free_memory(text);
    return result;
  } else {
    T value = 0;
    check(H5Aread(attribute.get(), memory_type<T>(), &value), label);
    return value;
  }
}
template double Hdf5File::attribute(const std::string&, const std::string&) const;
template std::int64_t Hdf5File::attribute(const std::string&, const std::string&) const;
template std::string Hdf5File::attribute(const std::string&, const std::string&) const;

namespace {

using Member = std::string Provenance::*;
constexpr std::array<std::pair<const char*, Member>, 6> origin{{{"title", &Provenance::title},
                                                                {"config", &Provenance::config},
                                                                {"version", &Provenance::version},
                                                                {"git_hash", &Provenance::git_hash},
                                                                {"backend", &Provenance::backend},
                                                                {"inputs", &Provenance::inputs}}};

}  // namespace

void write_provenance(Hdf5File& file, const Provenance& provenance) {
  for (const auto& [name, member] : origin) {
    if (member != &Provenance::inputs || !provenance.inputs.empty())
      file.set_attribute("/", name, provenance.*member);
  }
}

Provenance read_provenance(const Hdf5File& file) {
  Provenance provenance;
  for (const auto& [name, member] : origin) {
    if (file.has_attribute("/", name)) provenance.*member = file.attribute<std::string>("/", name);
  }
  return provenance;
}

}  // namespace barchan
