// Inside of hdf5_file: an identifier that closes itself, the library's reasons, and the serial
// driver.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

namespace barchan::hdf5 {

/// Closes with the function that belongs to the kind of object. Invalid (negative) ids are allowed,
/// so that a checker can look at get() afterwards.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t get() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// HDF5's name of a number type of ours.
template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
}

/// Starts the library once, without its printing of error stacks.
void start_library();

/// The innermost message of the library's error stack, or what the system said, in the user's
/// words. Call it before any other HDF5 function: each clears the stack.
std::string last_reason();

/// Place where the serial driver notes why the first system call failed. It must outlive the file.
struct DriverInfo {
  std::string* failure = nullptr;
};

/// The serial driver of hdf5_driver.cpp, for H5Pset_driver() with a DriverInfo.
hid_t file_driver();

}  // namespace barchan::hdf5
