# Finds Kokkos 4.6 to 5.x. Order: Kokkos_ROOT, CMAKE_PREFIX_PATH, the system, and last the private
# prefix that scripts/setup.sh makes where a system has none (see scripts/kokkos_prefix.sh).
# Kokkos says a version is compatible within one major number only, hence two questions per place.
if(DEFINED ENV{BARCHAN_DEPS})
  set(BARCHAN_DEPS "$ENV{BARCHAN_DEPS}")
else()
  get_filename_component(BARCHAN_DEPS "${CMAKE_CURRENT_LIST_DIR}/../build/deps" ABSOLUTE)
endif()

find_package(Kokkos 5 QUIET)
if(NOT Kokkos_FOUND)
  find_package(Kokkos 4.6 QUIET)
endif()
if(NOT Kokkos_FOUND)
  # The private prefix has the layout of a Debian root: <prefix>/usr/lib/<triplet>/cmake/Kokkos.
  file(GLOB kokkos_config_dirs "${BARCHAN_DEPS}/kokkos/usr/lib/*/cmake/Kokkos"
       "${BARCHAN_DEPS}/kokkos/usr/lib/cmake/Kokkos")
  find_package(Kokkos QUIET CONFIG PATHS ${kokkos_config_dirs} NO_DEFAULT_PATH)
endif()
if(NOT Kokkos_FOUND)
  message(FATAL_ERROR "Kokkos 4.6 to 5.x was not found. Run ./barchan setup, or set Kokkos_ROOT.")
endif()
if(BARCHAN_BACKEND AND NOT Kokkos_ENABLE_${BARCHAN_BACKEND})
  message(FATAL_ERROR "The Kokkos in ${Kokkos_DIR} was built for ${Kokkos_DEVICES}, without ${BARCHAN_BACKEND}. "
          "Set Kokkos_ROOT to one built with Kokkos_ENABLE_${BARCHAN_BACKEND}=ON.")
endif()
