# Messages, services and the catkin package. Comes before all targets: catkin_package() sets their output directories.
add_message_files(DIRECTORY msg FILES RotorState.msg BladeAngles.msg SwashplateCommand.msg ShaftState.msg)
add_service_files(DIRECTORY srv FILES Step.srv SaveSnapshot.srv LoadSnapshot.srv Trim.srv)
generate_messages(DEPENDENCIES std_msgs geometry_msgs)

# What another package gets with find_package(catkin COMPONENTS heerk_rotor).
set(exported_libraries heerk_rotor_ros)
set(exported_dependencies EIGEN3 YAML_CPP)
set(YAML_CPP_INCLUDE_DIRS ${YAML_CPP_INCLUDE_DIR})
set(YAML_CPP_LIBRARIES yaml-cpp)
if(HEERK_HAVE_LCM)
  list(APPEND exported_libraries heerk_rotor_lcm)
  list(APPEND exported_dependencies LCM)
  set(LCM_INCLUDE_DIRS ${LCM_INCLUDE_DIR})
  set(LCM_LIBRARIES ${LCM_LIBRARY})
endif()
catkin_package(
  INCLUDE_DIRS include
  LIBRARIES ${exported_libraries} heerk_rotor_core
  CATKIN_DEPENDS diagnostic_msgs diagnostic_updater geometry_msgs message_runtime nav_msgs roscpp rosgraph_msgs sensor_msgs
    std_msgs std_srvs tf2 tf2_ros visualization_msgs
  DEPENDS ${exported_dependencies})
