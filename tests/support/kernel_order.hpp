// Comes before every source file of the preset rehearsal: the items of a kernel in another order,
// as a device may take them. BARCHAN_ORDER=reversed: from the last to the first.
// BARCHAN_ORDER=shuffled: anyhow, and by threads as they are free. Reductions and scans keep their
// order.
#pragma once

#include <Kokkos_Core.hpp>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <string_view>
#include <type_traits>

namespace barchan::test {

enum class Order { as_written, reversed, shuffled };

inline Order order_of_kernels() {
  static const Order order = [] {
    const char* wanted = std::getenv("BARCHAN_ORDER");
    const std::string_view name = wanted == nullptr ? "" : wanted;
    return name == "reversed"   ? Order::reversed
           : name == "shuffled" ? Order::shuffled
                                : Order::as_written;
  }();
  return order;
}

/// The n items in some order: item(0), item(1) ...
class Permutation {
 public:
  Permutation(std::int64_t n, Order order) : n_(n) {
    if (order == Order::reversed) start_ = n - 1, step_ = n - 1;
    if (order == Order::shuffled) {
      start_ = n / 3;
      for (step_ = static_cast<std::int64_t>(0.618 * static_cast<double>(n)) | 1;
           std::gcd(step_, n) != 1;)
        ++step_;
    }
  }
  std::int64_t item(std::int64_t i) const { return (start_ + i * step_) % n_; }

 private:
  std::int64_t n_, start_ = 0, step_ = 1;
};

}  // namespace barchan::test

namespace Kokkos::Impl {

/// Specialisation that the constraint prefers to Kokkos' own.
template <class Functor, class... Traits>
requires std::is_void_v<typename RangePolicy<Traits...>::work_tag>
class ParallelFor<Functor, RangePolicy<Traits...>, OpenMP> {
  using Policy = RangePolicy<Traits...>;

 public:
  ParallelFor(const Functor& functor, const Policy& policy) : functor_(functor), policy_(policy) {}

  void execute() const {
    using barchan::test::Order;
    const auto n = static_cast<std::int64_t>(policy_.end() - policy_.begin());
    const Order order = barchan::test::order_of_kernels();
    const barchan::test::Permutation items(n, order);
    const auto work = [&](std::int64_t i) {
      functor_(policy_.begin() + static_cast<typename Policy::member_type>(items.item(i)));
    };
    if (order == Order::shuffled) {
#pragma omp parallel for schedule(dynamic, 1)
      for (std::int64_t i = 0; i < n; ++i) work(i);
    } else {
#pragma omp parallel for schedule(static)
      for (std::int64_t i = 0; i < n; ++i) work(i);
    }
  }

 private:
  Functor functor_;
  Policy policy_;
};

}  // namespace Kokkos::Impl
