# What `cmake --install` puts in place: the libraries, the public headers, and the files that
# find_package(tetrakis) and pkg-config read. Two components: the shared libraries that programs
# load, and what it takes to compile such programs.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/tetrakis)
set(libraries tetrakis_decoder_static tetrakis_static)
if(BUILD_SHARED_LIBS)
  list(APPEND libraries tetrakis_decoder_shared tetrakis_shared)
endif()

install(TARGETS ${libraries} EXPORT tetrakis
  LIBRARY COMPONENT library NAMELINK_COMPONENT development
  RUNTIME COMPONENT library
  ARCHIVE COMPONENT development)
install(EXPORT tetrakis FILE tetrakisTargets.cmake NAMESPACE tetrakis:: DESTINATION ${package}
  COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/tetrakis DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tetrakisConfig.cmake.in
  ${CMAKE_BINARY_DIR}/tetrakisConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/tetrakisConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/tetrakisConfig.cmake
  ${CMAKE_BINARY_DIR}/tetrakisConfigVersion.cmake DESTINATION ${package} COMPONENT development)

# Archives alone: everyone needs what they need. Beside a shared library: who links statically.
list(TRANSFORM TKS_RUNTIME PREPEND -l REGEX "^[^-]" OUTPUT_VARIABLE runtime)
list(JOIN runtime " " TKS_PC_RUNTIME)
string(APPEND TKS_PC_RUNTIME " -pthread")
if(BUILD_SHARED_LIBS)
  set(TKS_PC_LIBS "\nLibs.private: ${TKS_PC_RUNTIME}")
else()
  set(TKS_PC_LIBS " ${TKS_PC_RUNTIME}")
endif()
file(RELATIVE_PATH TKS_PC_UP ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" TKS_PC_UP ${TKS_PC_UP})
foreach(name IN ITEMS tetrakis tetrakis_decoder)
  set(TKS_PC_NAME ${name})
  configure_file(${CMAKE_CURRENT_LIST_DIR}/tetrakis.pc.in ${CMAKE_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${CMAKE_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
    COMPONENT development)
endforeach()
