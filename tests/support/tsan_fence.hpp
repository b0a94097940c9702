#pragma once
// Read before everything else in the thread preset (compile option -include). The thread sanitizer
// knows atomic operations but not fences (gcc's -Wtsan says so), and Kokkos' host barrier, compiled
// into our objects from its header, is made of relaxed operations with fences around them. So a
// fence becomes a call that the sanitizer understands: tests/support/tsan_openmp.cpp.
//
// Directives only: a declaration here would keep the compiler from using its precompiled headers.
// The function belongs to the namespace the fence stands in, desul::Impl; another would not link.
#define __atomic_thread_fence(order) \
  [] {                               \
    void barchan_tsan_fence();       \
    barchan_tsan_fence();            \
  }()
