# A room is a directory src/<room>; a library is made of one or more rooms. An empty library is skipped.
# Static, so that a program is one file and calls between rooms need no indirection; position independent (CompileOptions),
# so that shared libraries may use them.

# heerk_room_sources(<variable> ROOM...): all C++ files of the rooms.
function(heerk_room_sources variable)
  set(sources "")
  foreach(room IN LISTS ARGN)
    file(GLOB files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/${room}/*.cpp)
    list(APPEND sources ${files})
  endforeach()
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

# heerk_add_library(<target> ROOM... [EXCLUDE FILE...])
function(heerk_add_library target)
  cmake_parse_arguments(ARG "" "" "EXCLUDE" ${ARGN})
  heerk_room_sources(sources ${ARG_UNPARSED_ARGUMENTS})
  foreach(file IN LISTS ARG_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "/${file}$")
  endforeach()
  if(NOT sources)
    message(STATUS "heerk_rotor: no sources yet for ${target}")
    return()
  endif()
  add_library(${target} STATIC ${sources})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  set_property(GLOBAL APPEND PROPERTY HEERK_LIBRARIES ${target})
endfunction()
