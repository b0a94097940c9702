# For the presets hip and sycl: the compiler is the one that the Kokkos in Kokkos_ROOT was built with.
file(GLOB kokkos_records "$ENV{Kokkos_ROOT}/lib*/cmake/Kokkos/KokkosConfigCommon.cmake"
     "$ENV{Kokkos_ROOT}/lib/*/cmake/Kokkos/KokkosConfigCommon.cmake")
if(NOT DEFINED ENV{Kokkos_ROOT} OR NOT kokkos_records)
  message(FATAL_ERROR "Set Kokkos_ROOT to a Kokkos built with Kokkos_ENABLE_${BARCHAN_BACKEND}=ON; "
          "there is none in '$ENV{Kokkos_ROOT}'.")
endif()
list(GET kokkos_records 0 kokkos_record)
file(STRINGS "${kokkos_record}" kokkos_compiler REGEX "Kokkos_CXX_COMPILER \"" LIMIT_COUNT 1)
string(REGEX REPLACE ".*\"(.*)\".*" "\\1" kokkos_compiler "${kokkos_compiler}")
if(NOT EXISTS "${kokkos_compiler}")
  message(FATAL_ERROR "The Kokkos in $ENV{Kokkos_ROOT} was built with ${kokkos_compiler}, which is not here; "
          "name its successor with CXX=COMPILER.")
endif()
set(CMAKE_CXX_COMPILER "${kokkos_compiler}" CACHE FILEPATH "C++ compiler")
