# Compile options of our own code, carried by barchan_flags.
add_library(barchan_flags INTERFACE)
target_include_directories(barchan_flags INTERFACE "${CMAKE_SOURCE_DIR}")

# errno and trapping arithmetic would keep loops from being vectorised. Not -ffast-math: results must
# be reproducible, and not-a-number must stay visible to the checks that stop a run.
# No fused multiply-add on the compiler's own account: it would choose differently wherever a formula is
# inlined, and N steps in one call would no longer equal N calls of one step bit for bit.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -fno-math-errno -fno-trapping-math -ffp-contract=off")
set(CMAKE_CXX_FLAGS_DEBUG "-Og -g")

target_compile_options(barchan_flags INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wformat=2 -Wconversion)
if(NOT Kokkos_ENABLE_CUDA)  # nvcc's own intermediate code is neither pedantic nor free of warnings
  target_compile_options(barchan_flags INTERFACE -Wpedantic -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # False alarms of g++ 12 inside the headers of fmt and the standard library at -O3.
  target_compile_options(barchan_flags INTERFACE -Wno-maybe-uninitialized -Wno-stringop-overflow)
endif()
if(BARCHAN_NATIVE)
  target_compile_options(barchan_flags INTERFACE -march=native)
endif()
if(BARCHAN_SANITIZE)
  target_compile_options(barchan_flags INTERFACE -fsanitize=${BARCHAN_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=undefined)
  target_link_options(barchan_flags INTERFACE -fsanitize=${BARCHAN_SANITIZE})
endif()
