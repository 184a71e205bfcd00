# What `cmake --install` puts in place: the rooms below api/ as static libraries, the public headers,
# and the files that find_package(tetrakis) and pkg-config read.
include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY TKS_ROOMS)
set(archives ${CMAKE_INSTALL_LIBDIR}/tetrakis)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/tetrakis)

install(TARGETS ${rooms} tks_headers EXPORT tetrakis ARCHIVE DESTINATION ${archives})
install(EXPORT tetrakis FILE tetrakisTargets.cmake NAMESPACE tetrakis:: DESTINATION ${package})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/tetrakis DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tetrakisConfig.cmake.in
  ${CMAKE_BINARY_DIR}/tetrakisConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/tetrakisConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/tetrakisConfig.cmake
  ${CMAKE_BINARY_DIR}/tetrakisConfigVersion.cmake DESTINATION ${package})

# A room is defined after those that it uses; a linker wants users first.
list(REVERSE rooms)
list(TRANSFORM rooms PREPEND -l)
list(JOIN rooms " " TETRAKIS_ARCHIVES)
configure_file(${CMAKE_CURRENT_LIST_DIR}/tetrakis.pc.in ${CMAKE_BINARY_DIR}/tetrakis.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/tetrakis.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
