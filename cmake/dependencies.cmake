# Everything the library links, collected in BARCHAN_LIBRARIES. All headers come in as SYSTEM. The installed package
# includes this file, too: targets made here are imported, so that they are found anew there.
set(MPI_CXX_SKIP_MPICXX ON)  # the C interface only: MPI's C++ bindings are gone from the standard
find_package(MPI REQUIRED COMPONENTS CXX)

include("${CMAKE_CURRENT_LIST_DIR}/kokkos.cmake")

# Parallel HDF5, C interface. By pkg-config where it can: CMake's own search runs HDF5's compiler
# wrapper, which fails in a folder with a space in its name.
if(NOT DEFINED HDF5_ROOT AND NOT DEFINED ENV{HDF5_ROOT})
  find_package(PkgConfig QUIET)
  if(PkgConfig_FOUND)
    pkg_search_module(BARCHAN_HDF5 IMPORTED_TARGET hdf5-mpi hdf5-openmpi hdf5-mpich)
  endif()
endif()
if(BARCHAN_HDF5_FOUND)
  set(hdf5_target PkgConfig::BARCHAN_HDF5)
else()
  set(HDF5_PREFER_PARALLEL ON)
  find_package(HDF5 REQUIRED COMPONENTS C)
  if(NOT HDF5_IS_PARALLEL)
    message(FATAL_ERROR "The HDF5 in ${HDF5_INCLUDE_DIRS} is serial; a parallel (MPI) one is needed.")
  endif()
  set(hdf5_target hdf5::hdf5)
endif()

# Fourier transforms: cuFFT where Kokkos has CUDA, else FFTW.
add_library(barchan::fft INTERFACE IMPORTED)
if(Kokkos_ENABLE_CUDA)
  find_package(CUDAToolkit REQUIRED)
  target_link_libraries(barchan::fft INTERFACE CUDA::cufft)
else()
  # FFTW ships no CMake package that can be relied on; FFTW3_ROOT is honoured by find_*.
  find_path(FFTW3_INCLUDE_DIR fftw3.h REQUIRED)
  find_library(FFTW3_LIBRARY fftw3 REQUIRED)
  target_include_directories(barchan::fft SYSTEM INTERFACE "${FFTW3_INCLUDE_DIR}")
  target_link_libraries(barchan::fft INTERFACE "${FFTW3_LIBRARY}")
endif()

find_package(CLI11 REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
# toml++ is headers, and where it is packaged so also a library that spares compiling the parser.
find_path(TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h REQUIRED)
find_library(TOMLPLUSPLUS_LIBRARY tomlplusplus)
add_library(barchan::toml INTERFACE IMPORTED)
target_include_directories(barchan::toml SYSTEM INTERFACE "${TOMLPLUSPLUS_INCLUDE_DIR}")
if(TOMLPLUSPLUS_LIBRARY)
  target_compile_definitions(barchan::toml INTERFACE TOML_HEADER_ONLY=0 TOML_SHARED_LIB=1)
  target_link_libraries(barchan::toml INTERFACE "${TOMLPLUSPLUS_LIBRARY}")
endif()

set(BARCHAN_LIBRARIES Kokkos::kokkos MPI::MPI_CXX ${hdf5_target} barchan::fft CLI11::CLI11 Eigen3::Eigen
    fmt::fmt nlohmann_json::nlohmann_json ZLIB::ZLIB barchan::toml)
