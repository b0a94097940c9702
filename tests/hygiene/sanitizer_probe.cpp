// Deliberate mistakes, one a mode, and a mode without any: tests/hygiene/sanitizers.sh runs them
// first, to know that its reports can be believed. A sanitizer that is not in the program, or that
// is told too much about who comes after whom, would be content with everything.
#include <Kokkos_Core.hpp>

#include <climits>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr int n = 20000;
using Numbers = Kokkos::View<long*>;

/// Results of a loop are read by the next one, by other threads, and by the main thread.
void ordered_loops() {
  const Numbers a("a", n), b("b", n), sum("sum", 1);
  for (int repeat = 0; repeat < 20; ++repeat) {
    Kokkos::parallel_for(
        "fill", n, KOKKOS_LAMBDA(int i) { a(i) = i; });
    Kokkos::parallel_for(
        "turn", n, KOKKOS_LAMBDA(int i) { b(n - 1 - i) = a(i); });
    long total = 0;
    Kokkos::parallel_reduce(
        "sum", n, KOKKOS_LAMBDA(int i, long& s) { s += b(i); }, total);
    const auto running = KOKKOS_LAMBDA(int i, long& s, bool last) {
      s += b(i);
      if (last) a(n - 1 - i) = s;
    };
    Kokkos::parallel_scan("running sum", n, running, total);
    Kokkos::parallel_for(
        "atomic", n, KOKKOS_LAMBDA(int i) { Kokkos::atomic_add(&sum(0), a(i)); });
    a(n / 2) = sum(0);
  }
  using Team = Kokkos::TeamPolicy<>::member_type;
  const auto rows = KOKKOS_LAMBDA(const Team& team) {
    long total = 0;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, 100), [&](int i, long& s) { s += a(i); }, total);
    Kokkos::single(Kokkos::PerTeam(team), [&] { b(team.league_rank()) = total; });
  };
  Kokkos::parallel_for("teams", Kokkos::TeamPolicy<>(100, Kokkos::AUTO), rows);
  using Square = Kokkos::MDRangePolicy<Kokkos::Rank<2>>;
  Kokkos::parallel_for(
      "square", Square({0, 0}, {100, 100}),
      KOKKOS_LAMBDA(int i, int j) { a(100 * i + j) = b(100 * j + i); });
  std::printf("%ld\n", a(0));
}

void race_in_for() {
  const Numbers sum("sum", 1);
  Kokkos::parallel_for(
      "race", n, KOKKOS_LAMBDA(int i) { sum(0) += i; });
}

/// A neighbour's number, before or after it is written: only where two threads meet.
void race_of_neighbours() {
  const Numbers a("a", n);
  Kokkos::parallel_for(
      "race", n - 1, KOKKOS_LAMBDA(int i) { a(i) = a(i + 1) + 1; });
}

void race_in_reduce() {
  const Numbers count("count", 1);
  const auto add = KOKKOS_LAMBDA(int i, long& s) {
    s += i;
    count(0) = i;
  };
  long total = 0;
  Kokkos::parallel_reduce("race", n, add, total);
}

/// Race between the barriers of a scan, whose fences must not order more than they do.
void race_in_scan() {
  const Numbers count("count", 1);
  const auto add = KOKKOS_LAMBDA(int i, long& s, bool last) {
    s += i;
    if (last) count(0) += 1;
  };
  long total = 0;
  Kokkos::parallel_scan("race", n, add, total);
}

/// Race of a watchdog that looks at plain numbers.
void race_with_a_thread() {
  long beats = 0;
  std::thread other([&beats] { beats += 1; });
  Kokkos::parallel_for("work", n, KOKKOS_LAMBDA(int){});
  beats += 1;
  other.join();
}

void past_the_end() {
  const std::unique_ptr<double[]> numbers(new double[10]);
  volatile int i = 10;
  numbers[static_cast<std::size_t>(i)] = 1;
}

/// Inside the array, but in the next row: Kokkos' own check.
void past_the_row() {
  const Kokkos::View<double**> table("table", 10, 10);
  volatile int j = 10;
  table(3, j) = 1;
}

void past_the_vector() {
  std::vector<int> numbers;
  numbers.reserve(10);
  volatile std::size_t i = 3;
  numbers[i] = 1;
}

const double* kept = nullptr;

[[gnu::noinline]] void keep(const double& number) { kept = &number; }

[[gnu::noinline]] void keep_local() {
  const double local = 1;
  keep(local);
}

void after_return() {
  keep_local();
  std::printf("%g\n", *kept);
}

void overflow() {
  volatile int large = INT_MAX;
  std::printf("%d\n", large + 1);
}

void not_an_int() {
  volatile double large = 1e10;
  std::printf("%d\n", static_cast<int>(large));
}

/// Several: the address of the last one may still lie about on the stack.
void leak() {
  for (int k = 1; k <= 10; ++k) {
    auto* lost = new std::vector<int>(static_cast<std::size_t>(k));
    std::printf("%zu\n", lost->size());
  }
}

const std::map<std::string, std::function<void()>> modes = {
    {"ordered_loops", ordered_loops},
    {"race_in_for", race_in_for},
    {"race_of_neighbours", race_of_neighbours},
    {"race_in_reduce", race_in_reduce},
    {"race_in_scan", race_in_scan},
    {"race_with_a_thread", race_with_a_thread},
    {"past_the_end", past_the_end},
    {"past_the_row", past_the_row},
    {"past_the_vector", past_the_vector},
    {"after_return", after_return},
    {"overflow", overflow},
    {"not_an_int", not_an_int},
    {"leak", leak},
};

}  // namespace

int main(int argc, char** argv) {
  const auto mode = modes.find(argc == 2 ? argv[1] : "");
  if (mode == modes.end()) return 2;
  const Kokkos::ScopeGuard kokkos;
  mode->second();
  return 0;
}
