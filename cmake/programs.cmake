# The library and the programs: one of each for this machine's processor or, with BARCHAN_LEVELS, one for each level of
# instruction sets and a program that starts the best of them.
set(BARCHAN_LEVELS "" CACHE STRING "Levels to choose from at start, for example x86-64;x86-64-v3 (empty: one build)")

# A library of everything in src/ but programs.
function(barchan_core_library target)
  add_library(${target} STATIC ${core_sources})
  target_link_libraries(${target} PUBLIC barchan_flags barchan_version ${BARCHAN_LIBRARIES})
  if(BARCHAN_PCH)
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
  add_executable(${name} "${CMAKE_SOURCE_DIR}/src/run/best_program.cpp")
  foreach(level IN LISTS BARCHAN_LEVELS)
    add_executable(${name}.${level} ${arg_SOURCES})
    target_link_libraries(${name}.${level} PRIVATE barchan_core.${level} ${arg_LIBRARIES})
    add_dependencies(${name} ${name}.${level})
  endforeach()
endfunction()

barchan_core_library(barchan_core)
foreach(level IN LISTS BARCHAN_LEVELS)
  barchan_core_library(barchan_core.${level})
  target_compile_options(barchan_core.${level} PUBLIC -march=${level})
endforeach()
