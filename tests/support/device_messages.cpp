// Linked into every program of the preset rehearsal: messages of MPI come from the host's memory
// and go there, for not every MPI library reaches a device. One that does not ends as a host's
// access would (device_memory.cpp).
#include <mpi.h>
#include <sanitizer/asan_interface.h>

#include <cstdio>
#include <cstdlib>

namespace {

void check(const char* call, const void* numbers, int n, MPI_Datatype type) {
  if (n == 0 || numbers == nullptr || numbers == MPI_IN_PLACE) return;
  int bytes = 0;
  PMPI_Type_size(type, &bytes);
  void* const begin = const_cast<void*>(numbers);
  if (__asan_region_is_poisoned(
          begin, static_cast<std::size_t>(bytes) * static_cast<std::size_t>(n)) == nullptr)
    return;
  std::fprintf(stderr, "%s of an array of the device\n", call);
  __asan_report_error(__builtin_return_address(0), __builtin_frame_address(0),
                      __builtin_frame_address(0), begin, 0, 1);
  std::abort();
}

}  // namespace

extern "C" {

int MPI_Isend(const void* numbers, int n, MPI_Datatype type, int to, int tag, MPI_Comm ranks,
              MPI_Request* request) {
  check("MPI_Isend", numbers, n, type);
  return PMPI_Isend(numbers, n, type, to, tag, ranks, request);
}

int MPI_Irecv(void* numbers, int n, MPI_Datatype type, int from, int tag, MPI_Comm ranks,
              MPI_Request* request) {
  check("MPI_Irecv", numbers, n, type);
  return PMPI_Irecv(numbers, n, type, from, tag, ranks, request);
}

int MPI_Allreduce(const void* mine, void* all, int n, MPI_Datatype type, MPI_Op operation,
                  MPI_Comm ranks) {
  check("MPI_Allreduce", mine, n, type);
  check("MPI_Allreduce", all, n, type);
  return PMPI_Allreduce(mine, all, n, type, operation, ranks);
}

int MPI_Bcast(void* numbers, int n, MPI_Datatype type, int from, MPI_Comm ranks) {
  check("MPI_Bcast", numbers, n, type);
  return PMPI_Bcast(numbers, n, type, from, ranks);
}
}
