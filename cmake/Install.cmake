# Libraries, headers, programs and the files that roslaunch and users look for.
if(NOT HEERK_HAVE_ROS)  # otherwise catkin_package() has set the same ones
  set(CATKIN_GLOBAL_LIB_DESTINATION lib)
  set(CATKIN_PACKAGE_BIN_DESTINATION lib/${PROJECT_NAME})
  set(CATKIN_GLOBAL_INCLUDE_DESTINATION include)
  set(CATKIN_PACKAGE_SHARE_DESTINATION share/${PROJECT_NAME})
endif()

get_property(libraries GLOBAL PROPERTY HEERK_LIBRARIES)
install(TARGETS ${libraries} ARCHIVE DESTINATION ${CATKIN_GLOBAL_LIB_DESTINATION})
foreach(program simulate rotor_node)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
  endif()
endforeach()

install(DIRECTORY include/${PROJECT_NAME} DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION})
if(HEERK_HAVE_LCM)
  install(DIRECTORY ${HEERK_LCM_HEADER_DIR}/${PROJECT_NAME} DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION}
    FILES_MATCHING PATTERN "*_t.hpp")
endif()
install(DIRECTORY config launch urdf rviz lcm DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(FILES LICENSE DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})

file(GLOB scripts CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/scripts/*.py)
list(FILTER scripts EXCLUDE REGEX "(paper_lag_rotor|check_includes|performance_report|robot_description)\\.py$")  # work on the source tree
install(PROGRAMS ${scripts} DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(PROGRAMS scripts/robot_description.py DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/scripts)  # rotor.launch calls it; beside urdf/
install(DIRECTORY scripts/rotor_analysis DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION} FILES_MATCHING PATTERN "*.py")
