# <build>/generated/barchan_version.hpp with BARCHAN_VERSION and BARCHAN_GIT_HASH. Looked at in every
# build, rewritten only when its content changes: only the files that include it are compiled again.
set(version_header "${PROJECT_BINARY_DIR}/generated/barchan_version.hpp")
set(write_version ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -D HEADER=${version_header}
    -D VERSION=${PROJECT_VERSION} -P ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake)
execute_process(COMMAND ${write_version})
add_custom_target(barchan_write_version ALL COMMAND ${write_version} BYPRODUCTS "${version_header}"
                  COMMENT "" VERBATIM)
add_library(barchan_version INTERFACE)
target_include_directories(barchan_version INTERFACE "${PROJECT_BINARY_DIR}/generated")
add_dependencies(barchan_version barchan_write_version)
