# What users link: all rooms below api/ in one archive each, for decoding alone and for both, and
# with BUILD_SHARED_LIBS in one shared library each that exports the functions of tetrakis.h.

# Every library that `target` links, directly or not.
function(tks_closure target out)
  set(open ${target})
  set(closed)
  while(open)
    list(POP_FRONT open next)
    if(next IN_LIST closed)
      continue()
    endif()
    list(APPEND closed ${next})
    if(TARGET ${next})
      get_target_property(libraries ${next} INTERFACE_LINK_LIBRARIES)
      if(libraries)
        list(APPEND open ${libraries})
      endif()
    endif()
  endwhile()
  list(REMOVE_ITEM closed ${target})
  set(${out} ${closed} PARENT_SCOPE)
endfunction()

# Where the linker takes a list of what to export; symbols are hidden elsewhere too.
include(CheckLinkerFlag)
set(TKS_EXPORT_LIST ${CMAKE_CURRENT_LIST_DIR}/exports.map)
set(TKS_EXPORTS -Wl,--version-script=${TKS_EXPORT_LIST})
check_linker_flag(CXX ${TKS_EXPORTS} TKS_HAS_EXPORTS)

# The archives are C++ inside, but a C compiler may link them: they name what else that takes.
find_package(Threads REQUIRED)
set(TKS_RUNTIME ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_ITEM TKS_RUNTIME ${CMAKE_C_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_DUPLICATES TKS_RUNTIME)
list(APPEND TKS_RUNTIME ${CMAKE_THREAD_LIBS_INIT})

function(tks_library target name)
  set_target_properties(${target} PROPERTIES
    OUTPUT_NAME ${name}
    LINKER_LANGUAGE CXX
    ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
  target_include_directories(${target} INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()

function(tks_libraries name)
  tks_closure(${name} below)
  set(objects $<TARGET_OBJECTS:${name}>)
  foreach(room IN LISTS below)
    if(room MATCHES "^t" AND NOT room STREQUAL "tks_headers")
      list(APPEND objects $<TARGET_OBJECTS:${room}>)
    endif()
  endforeach()
  add_library(${name}_static STATIC ${objects})
  target_link_libraries(${name}_static PRIVATE ${TKS_RUNTIME})
  tks_library(${name}_static ${name})
  add_library(tetrakis::${name}_static ALIAS ${name}_static)
  if(NOT BUILD_SHARED_LIBS)
    add_library(tetrakis::${name} ALIAS ${name}_static)
    return()
  endif()
  add_library(${name}_shared SHARED ${objects})
  target_link_libraries(${name}_shared PRIVATE ${CMAKE_THREAD_LIBS_INIT})
  if(TKS_HAS_EXPORTS)
    target_link_options(${name}_shared PRIVATE ${TKS_EXPORTS})
    set_target_properties(${name}_shared PROPERTIES LINK_DEPENDS ${TKS_EXPORT_LIST})
  endif()
  tks_library(${name}_shared ${name})
  set_target_properties(${name}_shared PROPERTIES
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  add_library(tetrakis::${name} ALIAS ${name}_shared)
endfunction()

tks_libraries(tetrakis_decoder)
tks_libraries(tetrakis)
