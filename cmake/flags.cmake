# Compile options of our own code, carried by barchan_flags.
add_library(barchan_flags INTERFACE)
target_include_directories(barchan_flags INTERFACE "${PROJECT_SOURCE_DIR}")

# In place of what CMake takes by itself (with NDEBUG, which would drop checks of Kokkos); what a user gives stays.
macro(barchan_flags_of config cmakes_own ours)
  if(CMAKE_CXX_FLAGS_${config} STREQUAL "${cmakes_own}")
    set(CMAKE_CXX_FLAGS_${config} "${ours}")
  endif()
endmacro()
barchan_flags_of(RELEASE "-O3 -DNDEBUG" "-O3")
barchan_flags_of(RELWITHDEBINFO "-O2 -g -DNDEBUG" "-O2 -g")
barchan_flags_of(DEBUG "-g" "-O1 -g")
# Which lines the tests reach (tests/hygiene/coverage.sh).
barchan_flags_of(COVERAGE "" "-O1 --coverage -fprofile-abs-path")
set(CMAKE_EXE_LINKER_FLAGS_COVERAGE "--coverage")

# errno and trapping arithmetic would keep loops from being vectorised. Not -ffast-math: results must
# be reproducible, and not-a-number must stay visible to the checks that stop a run.
# No fused multiply-add on the compiler's own account: it would choose differently wherever a formula is
# inlined, and N steps in one call would no longer equal N calls of one step bit for bit.
target_compile_options(barchan_flags INTERFACE -fno-math-errno -fno-trapping-math -ffp-contract=off)
target_compile_options(barchan_flags INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wformat=2 -Wconversion)
if(NOT Kokkos_ENABLE_CUDA)
  target_compile_options(barchan_flags INTERFACE -Wpedantic)
else()
  # The intermediate code that nvcc hands to the host compiler is not pedantic and has parentheses of
  # its own. No fused multiply-add, as above.
  target_compile_options(barchan_flags INTERFACE --fmad=false -Wno-parentheses)
  if(CMAKE_COMPILE_WARNING_AS_ERROR)  # of nvcc's front end
    target_compile_options(barchan_flags INTERFACE --Werror=all-warnings)
  endif()
  # fmt 9 halves it for nvcc.
  target_compile_definitions(barchan_flags INTERFACE FMT_USE_CONSTEXPR=1)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # False alarms of g++ 12 inside the headers of fmt and the standard library at -O3.
  target_compile_options(barchan_flags INTERFACE -Wno-maybe-uninitialized -Wno-stringop-overflow)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  # As g++ has it: "GCC ivdep" is known, -Wconversion does not look at signs, and what libstdc++ calls of
  # its own is its own affair.
  target_compile_options(barchan_flags INTERFACE -Wno-unknown-pragmas -Wno-sign-conversion
    -Wno-deprecated-declarations)
  # g++ has it by itself, but for KOKKOS_LAMBDA, which is a macro of a system header.
  target_compile_options(barchan_flags INTERFACE -Wdeprecated-this-capture)
endif()
# Where Kokkos was built for a processor, its flags come with it.
if(BARCHAN_ENABLE_NATIVE AND NOT Kokkos_ARCH MATCHES "NATIVE|AMD|ARM|ZEN|SKX|KNL|HSW|BDW|ICX|SPR|POWER|A64FX|APPLE")
  target_compile_options(barchan_flags INTERFACE -march=native)
  # Full vectors of AVX-512: compilers take halves of them for the sake of the clock of older processors.
  include(CheckCXXCompilerFlag)
  check_cxx_compiler_flag(-mprefer-vector-width=512 BARCHAN_HAS_VECTOR_WIDTH)
  if(BARCHAN_HAS_VECTOR_WIDTH)
    target_compile_options(barchan_flags INTERFACE -mprefer-vector-width=512)
  endif()
endif()
if(BARCHAN_SANITIZE)
  target_compile_options(barchan_flags INTERFACE -fsanitize=${BARCHAN_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  target_link_options(barchan_flags INTERFACE -fsanitize=${BARCHAN_SANITIZE})
  # A subscript past its row, but still inside the array, is nothing to the address sanitizer: these are.
  target_compile_definitions(barchan_flags INTERFACE _GLIBCXX_ASSERTIONS)
  # A read beyond the cells that a kernel wrote stays inside its array: no number is there (src/parallel/poison.hpp).
  target_compile_definitions(barchan_flags INTERFACE BARCHAN_POISON)
  # A read beyond the region of a kernel stays inside its array: there is no number (src/parallel/poison.hpp).
  target_compile_definitions(barchan_flags INTERFACE BARCHAN_POISON)
  if(BARCHAN_SANITIZE MATCHES thread)
    # How OpenMP and Kokkos order the threads, in words that the thread sanitizer knows.
    add_library(barchan_sanitize OBJECT tests/support/tsan_openmp.cpp)
    target_compile_options(barchan_flags INTERFACE -g1
      "SHELL:-include \"${PROJECT_SOURCE_DIR}/tests/support/tsan_fence.hpp\"")
  else()
    add_library(barchan_sanitize OBJECT tests/support/keep_libraries.cpp)
    target_compile_definitions(barchan_flags INTERFACE KOKKOS_ENABLE_DEBUG_BOUNDS_CHECK)
  endif()
  if(BARCHAN_ENABLE_REHEARSAL)
    target_sources(barchan_sanitize PRIVATE tests/support/device_memory.cpp tests/support/device_messages.cpp)
    target_compile_definitions(barchan_flags INTERFACE BARCHAN_REHEARSAL)
    set(kernel_order "${PROJECT_SOURCE_DIR}/tests/support/kernel_order.hpp")
    if(BARCHAN_ENABLE_PCH)
      target_precompile_headers(barchan_flags INTERFACE "${kernel_order}")
    else()
      target_compile_options(barchan_flags INTERFACE "SHELL:-include \"${kernel_order}\"")
    endif()
  endif()
  target_link_libraries(barchan_sanitize PRIVATE Kokkos::kokkos MPI::MPI_CXX)
  target_compile_options(barchan_sanitize PRIVATE $<TARGET_PROPERTY:barchan_flags,INTERFACE_COMPILE_OPTIONS>)
  target_sources(barchan_flags INTERFACE $<TARGET_OBJECTS:barchan_sanitize>)
endif()
