# cmake --install: the program, and the package Barchan with barchan::kernels (headers) and barchan::core (all but
# the program). A user's own code: find_package(Barchan), #include <barchan/kernels/grains/contact_law.hpp>.
include(CMakePackageConfigHelpers)
# A Kokkos that is not of the system stays where it is. (CMake does not count a folder in our own build as such.)
set(install_rpath INSTALL_RPATH_USE_LINK_PATH ON INSTALL_RPATH "$<TARGET_FILE_DIR:Kokkos::kokkoscore>")
set_target_properties(barchan PROPERTIES ${install_rpath})
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/Barchan")

install(TARGETS barchan RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
foreach(level IN LISTS BARCHAN_LEVELS)
  set_target_properties(barchan.${level} PROPERTIES ${install_rpath})
  install(TARGETS barchan.${level} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endforeach()
install(TARGETS barchan_core barchan_kernels EXPORT BarchanTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/kernels" "${PROJECT_SOURCE_DIR}/src"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/barchan" FILES_MATCHING PATTERN "*.hpp")
install(FILES "${version_header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/barchan")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/configs" DESTINATION "${CMAKE_INSTALL_DATADIR}/barchan")

install(EXPORT BarchanTargets NAMESPACE barchan:: DESTINATION "${package_folder}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/BarchanConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/BarchanConfig.cmake" INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/BarchanConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/BarchanConfig.cmake" "${PROJECT_BINARY_DIR}/BarchanConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/dependencies.cmake" "${PROJECT_SOURCE_DIR}/cmake/kokkos.cmake"
  DESTINATION "${package_folder}")
