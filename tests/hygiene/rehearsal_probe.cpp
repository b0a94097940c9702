// Deliberate mistakes with arrays of the device, one a mode, and modes without any:
// tests/hygiene/sanitizers.sh runs them first, to know that its reports can be believed.
#include <mpi.h>

#include <Kokkos_Core.hpp>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "src/parallel/sort.hpp"

namespace {

using barchan::host_copy, barchan::mirror, barchan::sort_by_key;

constexpr int n = 1000;
using Numbers = Kokkos::View<double*>;

Numbers filled() {
  const Numbers a("numbers", n);
  Kokkos::parallel_for(
      "fill", n, KOKKOS_LAMBDA(int i) { a(i) = n - i; });
  return a;
}

/// All that a host may do.
void with_copies() {
  const Numbers a = filled(), b("copy", n), c = filled();
  Kokkos::deep_copy(b, 2.0);
  Kokkos::deep_copy(b, a);
  Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), Kokkos::subview(b, 3), 7.0);
  sort_by_key(a, c);
  const auto host = mirror(b);
  for (int i = 0; i < n; ++i) host(i) = i;
  Kokkos::deep_copy(b, host);
  double sum = 0, one = 0;
  Kokkos::parallel_reduce(
      "sum", n, KOKKOS_LAMBDA(int i, double& s) { s += a(i) + b(i); }, sum);
  Kokkos::deep_copy(one, Kokkos::subview(a, 5));
  const Kokkos::View<double*, Kokkos::HostSpace> ours("host: ours", n);
  ours(3) = host_copy(a)(3);
  std::printf("%g %g %g\n", sum, one, ours(3));
}

/// Arrays come and go, and the memory of those that went is anybody's.
void memory_again() {
  for (int repeat = 0; repeat < 100; ++repeat) {
    filled();
    std::vector<double> ours(n, 1.0);
    std::printf("%g\n", ours[5]);
  }
}

/// Error that no check reports, but another number in another order: kernel_order.py must see it.
void depends_on_order() {
  const Numbers a("numbers", n);
  Kokkos::parallel_for(
      "each from the last", n, KOKKOS_LAMBDA(int i) { a(i) = i == 0 ? 0 : a(i - 1) + 1; });
  double sum = 0;
  Kokkos::parallel_reduce(
      "sum", n, KOKKOS_LAMBDA(int i, double& s) { s += a(i); }, sum);
  std::printf("%g\n", sum);
}

void read() {
  const Numbers a = filled();
  std::printf("%g\n", a(5));
}

void write() {
  const Numbers a = filled();
  a(5) = 3;
}

void read_a_part() {
  const auto part = Kokkos::subview(filled(), std::pair(10, 20));
  std::printf("%g\n", part(5));
}

void read_before_any_kernel() {
  const Numbers a(Kokkos::view_alloc("fresh", Kokkos::WithoutInitializing), n);
  std::printf("%g\n", a(5));
}

void view_of_a_mirror() {
  const Numbers a = filled();
  const auto host = Kokkos::create_mirror_view(a);  // not barchan::mirror()
  Kokkos::deep_copy(host, a);
  std::printf("%g\n", host(5));
}

void copy_by_hand() {
  const Numbers a = filled();
  std::vector<double> ours(n);
  std::memcpy(ours.data(), a.data(), n * sizeof(double));
  std::printf("%g\n", ours[5]);
}

void sort_by_hand() {
  const Numbers a = filled();
  std::sort(a.data(), a.data() + n);
}

void send() {
  Numbers a = filled();
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Isend(a.data(), n, MPI_DOUBLE, 0, 0, MPI_COMM_SELF, &request);
}

const std::map<std::string, std::function<void()>> modes = {
    {"with_copies", with_copies},
    {"memory_again", memory_again},
    {"depends_on_order", depends_on_order},
    {"read", read},
    {"write", write},
    {"read_a_part", read_a_part},
    {"read_before_any_kernel", read_before_any_kernel},
    {"view_of_a_mirror", view_of_a_mirror},
    {"copy_by_hand", copy_by_hand},
    {"sort_by_hand", sort_by_hand},
    {"send", send},
};

}  // namespace

int main(int argc, char** argv) {
  const auto mode = modes.find(argc == 2 ? argv[1] : "");
  if (mode == modes.end()) return 2;
  MPI_Init(&argc, &argv);
  {
    const Kokkos::ScopeGuard kokkos;
    mode->second();
  }
  MPI_Finalize();
  return 0;
}
