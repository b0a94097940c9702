# The library and the programs: one of each for this machine's processor or, with BARCHAN_LEVELS, one for each level of
# instruction sets and a program that starts the best of them.
set(BARCHAN_LEVELS "" CACHE STRING "Levels to choose from at start, for example x86-64;x86-64-v3 (empty: one build)")

# The formulas alone: headers that need nothing but Kokkos. In our own code they are "kernels/...", where they are
# installed also <barchan/kernels/...>.
add_library(barchan_kernels INTERFACE)
add_library(barchan::kernels ALIAS barchan_kernels)
set_target_properties(barchan_kernels PROPERTIES EXPORT_NAME kernels)
target_compile_features(barchan_kernels INTERFACE cxx_std_20)
target_include_directories(barchan_kernels INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
  "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/barchan>")
target_link_libraries(barchan_kernels INTERFACE Kokkos::kokkos)

# A library of everything in src/ but programs. What its headers do not show is private.
set(private_libraries CLI11::CLI11 Eigen3::Eigen ZLIB::ZLIB barchan::toml barchan::fft)
set(public_libraries ${BARCHAN_LIBRARIES})
list(REMOVE_ITEM public_libraries ${private_libraries})
function(barchan_core_library target)
  add_library(${target} STATIC ${core_sources})
  target_link_libraries(${target} PUBLIC barchan_kernels ${public_libraries}
    "$<BUILD_INTERFACE:barchan_flags>" "$<BUILD_INTERFACE:barchan_version>"
    PRIVATE ${private_libraries})
  target_compile_definitions(${target} PRIVATE EIGEN_NO_CUDA)  # it serves the host alone
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${BARCHAN_ENABLE_UNITY} UNITY_BUILD_MODE GROUP)
  if(BARCHAN_ENABLE_PCH)
    target_precompile_headers(${target} PRIVATE <Kokkos_Core.hpp> <mpi.h> <filesystem> <string> <vector>)
  endif()
endfunction()

# barchan_program(NAME SOURCES ... LIBRARIES ...)
function(barchan_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT BARCHAN_LEVELS)
    add_executable(${name} ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE barchan_core ${arg_LIBRARIES})
    return()
  endif()
  add_executable(${name} "${PROJECT_SOURCE_DIR}/src/app/best_program.cpp")
  foreach(level IN LISTS BARCHAN_LEVELS)
    add_executable(${name}.${level} ${arg_SOURCES})
    target_link_libraries(${name}.${level} PRIVATE barchan_core.${level} ${arg_LIBRARIES})
    add_dependencies(${name} ${name}.${level})
  endforeach()
endfunction()

barchan_core_library(barchan_core)
add_library(barchan::core ALIAS barchan_core)
set_target_properties(barchan_core PROPERTIES EXPORT_NAME core)
foreach(level IN LISTS BARCHAN_LEVELS)
  barchan_core_library(barchan_core.${level})
  target_compile_options(barchan_core.${level} PUBLIC -march=${level})
endforeach()
