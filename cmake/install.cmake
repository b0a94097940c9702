# cmake --install: all that a user needs (component "program"), and for code of others the package Barchan with
# barchan::kernels (headers) and barchan::core (all but the program). A user's own code: find_package(Barchan),
# #include <barchan/kernels/grains/contact_law.hpp>. packaging/README.md says what lies where.
include(CMakePackageConfigHelpers)

# --- what a user needs -------------------------------------------------------------------------------------------
# Folders that the launcher finds beside its own.
set(launcher_folder bin)
set(program_folder libexec/barchan)
set(share_folder share/barchan)
set(BARCHAN_INSTALL_PYTHONDIR "${share_folder}/python" CACHE STRING "Where the Python package goes below the prefix")
set(barchan_doc_folder share/doc/barchan)

# A Kokkos that is not of the system stays where it is; a static one needs no path. (CMake does not count a folder in
# our own build as such.)
set(programs barchan)
foreach(level IN LISTS BARCHAN_LEVELS)
  list(APPEND programs barchan.${level})
endforeach()
get_target_property(kokkos_type Kokkos::kokkoscore TYPE)
if(NOT kokkos_type STREQUAL STATIC_LIBRARY)
  set_target_properties(${programs} PROPERTIES INSTALL_RPATH_USE_LINK_PATH ON
    INSTALL_RPATH "$<TARGET_FILE_DIR:Kokkos::kokkoscore>")
endif()
install(TARGETS ${programs} RUNTIME DESTINATION "${program_folder}" COMPONENT program)
install(PROGRAMS barchan DESTINATION "${launcher_folder}" COMPONENT program)
install(DIRECTORY configs DESTINATION "${share_folder}" COMPONENT program)
install(FILES scripts/progress.sh scripts/usage.sh DESTINATION "${share_folder}" COMPONENT program)
install(DIRECTORY python/barchan DESTINATION "${BARCHAN_INSTALL_PYTHONDIR}" COMPONENT program
  PATTERN __pycache__ EXCLUDE)
# What tells xarray of its engine "barchan", as of python/pyproject.toml.
set(metadata "${PROJECT_BINARY_DIR}/python.dist-info")
file(WRITE "${metadata}/METADATA" "Metadata-Version: 2.1\nName: barchan\nVersion: ${PROJECT_VERSION}\n")
file(WRITE "${metadata}/entry_points.txt" [=[
[xarray.backends]
barchan = barchan.io.fields:Fields
]=])
install(DIRECTORY "${metadata}/" COMPONENT program
  DESTINATION "${BARCHAN_INSTALL_PYTHONDIR}/barchan-${PROJECT_VERSION}.dist-info")
install(FILES LICENSE README.md CHANGELOG.md DESTINATION "${barchan_doc_folder}" COMPONENT program)
install(DIRECTORY docs notebooks DESTINATION "${barchan_doc_folder}" COMPONENT program)
install(FILES scripts/completion.bash DESTINATION share/bash-completion/completions RENAME barchan COMPONENT program)
# The man page is made from what the installed launcher says of itself.
install(CODE "execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND python3
  \"${PROJECT_SOURCE_DIR}/packaging/write_man.py\" \"\$ENV{DESTDIR}\" \"\${CMAKE_INSTALL_PREFIX}\" ${PROJECT_VERSION})"
  COMPONENT program)

# --- for code of others ------------------------------------------------------------------------------------------
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/Barchan")
install(TARGETS barchan_core barchan_kernels EXPORT BarchanTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library)
install(DIRECTORY kernels src DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/barchan" COMPONENT library
  FILES_MATCHING PATTERN "*.hpp")
install(FILES "${version_header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/barchan" COMPONENT library)

install(EXPORT BarchanTargets NAMESPACE barchan:: DESTINATION "${package_folder}" COMPONENT library)
configure_package_config_file(cmake/BarchanConfig.cmake.in
  "${PROJECT_BINARY_DIR}/BarchanConfig.cmake" INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/BarchanConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/BarchanConfig.cmake" "${PROJECT_BINARY_DIR}/BarchanConfigVersion.cmake"
  cmake/dependencies.cmake cmake/kokkos.cmake DESTINATION "${package_folder}" COMPONENT library)
