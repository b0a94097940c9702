// Linked into every program of the thread preset: tells the thread sanitizer how OpenMP and Kokkos
// order what threads do. gcc's libgomp waits by futex and the Kokkos library is prebuilt; neither
// is instrumented, so without this file every parallel loop looks like a race with what comes
// before and after it. With it there is nothing to suppress in either, and what two threads of one
// loop do to the same memory stays visible.
#include <dlfcn.h>
#include <sched.h>

#include <Kokkos_Core.hpp>

extern "C" {
void __tsan_acquire(void* address);
void __tsan_release(void* address);
}

namespace desul::Impl {
void barchan_tsan_fence();  // tests/support/tsan_fence.hpp
}

namespace {

using Body = void (*)(void*);

struct Region {
  Body body;
  void* data;
  // Two marks: with one, a thread that starts late would seem to come after one that ended early,
  // and their races would be hidden.
  char start = 0;
  char end = 0;
};

__attribute__((no_sanitize("thread"))) void enter(void* argument) {
  auto* region = static_cast<Region*>(argument);
  __tsan_acquire(&region->start);
  region->body(region->data);
  __tsan_release(&region->end);
}

char fence = 0;

}  // namespace

extern "C" {

/// The entry of every `#pragma omp parallel`, ours and the Kokkos library's: the program's own
/// comes before libgomp's. What the calling thread did is seen by all threads, what they did by the
/// caller afterwards.
__attribute__((no_sanitize("thread"))) void GOMP_parallel(Body body, void* data, unsigned n_threads,
                                                          unsigned flags) {
  using Parallel = void (*)(Body, void*, unsigned, unsigned);
  static const auto real = reinterpret_cast<Parallel>(dlsym(RTLD_NEXT, "GOMP_parallel"));
  Region region{body, data};
  __tsan_release(&region.start);
  real(enter, &region, n_threads, flags);
  __tsan_acquire(&region.end);
}
}

/// A fence comes after all fences before it: more than the standard promises, and never less than
/// was meant. Within a loop only Kokkos' barriers have any, which do order the threads.
__attribute__((no_sanitize("thread"))) void desul::Impl::barchan_tsan_fence() {
  asm volatile("mfence" ::: "memory");
  __tsan_acquire(&fence);
  __tsan_release(&fence);
}

// The end of a long wait, which is in the Kokkos library: there its fence would not be seen.
void Kokkos::Impl::HostBarrier::impl_backoff_wait_until_equal(int* ptr, const int v,
                                                              const bool) noexcept {
  while (!test_equal(ptr, v)) sched_yield();
}
