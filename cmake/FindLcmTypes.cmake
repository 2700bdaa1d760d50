# Looks for LCM (its pkg-config file needs a glib one that is not always there) and generates the C++ headers of lcm/.
# Sets HEERK_HAVE_LCM; the target heerk_rotor_lcm_types brings <heerk_rotor/rotor_state_t.hpp> and the LCM library.
find_program(LCM_GEN lcm-gen)
find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp)
find_library(LCM_LIBRARY lcm)
mark_as_advanced(LCM_GEN LCM_INCLUDE_DIR LCM_LIBRARY)

set(HEERK_HAVE_LCM OFF)
if(LCM_GEN AND LCM_INCLUDE_DIR AND LCM_LIBRARY)
  set(HEERK_HAVE_LCM ON)
  set(HEERK_LCM_HEADER_DIR ${CATKIN_DEVEL_PREFIX}/include)  # beside the ROS messages
  file(GLOB types CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/lcm/${PROJECT_NAME}/*.lcm)
  set(headers "")
  foreach(type IN LISTS types)
    get_filename_component(name ${type} NAME_WE)
    set(header ${HEERK_LCM_HEADER_DIR}/${PROJECT_NAME}/${name}.hpp)
    add_custom_command(OUTPUT ${header}
      COMMAND ${LCM_GEN} --cpp --cpp-std c++11 --cpp-hpath ${HEERK_LCM_HEADER_DIR} ${type}
      DEPENDS ${type} COMMENT "Generating LCM type ${name}" VERBATIM)
    list(APPEND headers ${header})
  endforeach()
  add_custom_target(heerk_rotor_generate_lcm DEPENDS ${headers})
  add_library(heerk_rotor_lcm_types INTERFACE)
  add_dependencies(heerk_rotor_lcm_types heerk_rotor_generate_lcm)
  target_include_directories(heerk_rotor_lcm_types SYSTEM INTERFACE ${HEERK_LCM_HEADER_DIR} ${LCM_INCLUDE_DIR})
  target_link_libraries(heerk_rotor_lcm_types INTERFACE ${LCM_LIBRARY})
endif()
message(STATUS "heerk_rotor: LCM ${HEERK_HAVE_LCM}")
