// Memory of fields that hold nothing just now, for others to use meanwhile.
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/grid.hpp"

namespace barchan {

/// Gives out pieces of some fields, which nobody reads before their owner has written them again.
class IdleMemory {
 public:
  IdleMemory() = default;
  explicit IdleMemory(const std::vector<Field>& fields) {
    for (const Field& field : fields) blocks_.push_back({.field = field, .used = 0});
  }

  /// What was given out is no longer in use.
  void free_all() {
    for (Block& block : blocks_) block.used = 0;
  }

  /// Room for n values, not initialised, in the first field that has it; a view without extent where
  /// none has. The view does not keep the field alive, this does.
  template <class T>
  Kokkos::View<T*> take(std::size_t n) {
    const std::size_t bytes = (n * sizeof(T) + kAlignment - 1) / kAlignment * kAlignment;
    for (Block& block : blocks_) {
      if (block.field.storage.span() * sizeof(Real) - block.used < bytes) continue;
      auto* const place = reinterpret_cast<std::byte*>(block.field.storage.data()) + block.used;
      block.used += bytes;
      return Kokkos::View<T*>(reinterpret_cast<T*>(place), n);
    }
    return {};
  }

 private:
  static constexpr std::size_t kAlignment = 64;  // [bytes], as Kokkos' own
  struct Block {
    Field field;
    std::size_t used = 0;  // [bytes] from its start
  };
  std::vector<Block> blocks_;
};

}  // namespace barchan
