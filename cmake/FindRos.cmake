# Looks for catkin and the ROS 1 packages the node needs. Sets HEERK_HAVE_ROS, HEERK_HAVE_ROSBAG, HEERK_PROGRAM_DIR
# (where executables land: build/devel/lib/heerk_rotor with and without ROS) and HEERK_PYTHON.

# Messages, rostests and catkin belong to the system's Python; another python3 may stand first on PATH.
if(EXISTS /usr/bin/python3)
  if(NOT DEFINED PYTHON_EXECUTABLE)
    set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python of catkin and the message generators")
  endif()
  if(NOT DEFINED Python3_EXECUTABLE)
    set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python of rosbag and the scripts")
  endif()
endif()

set(HEERK_ROS_COMPONENTS roscpp std_msgs geometry_msgs sensor_msgs nav_msgs visualization_msgs diagnostic_msgs
  rosgraph_msgs std_srvs tf2 tf2_ros diagnostic_updater message_generation)

# The first configure caches PYTHONPATH for the tests, and only of directories that exist by then.
if(NOT CATKIN_DEVEL_PREFIX)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/devel/lib/python3/dist-packages)
endif()

set(HEERK_HAVE_ROS OFF)
set(HEERK_HAVE_ROSBAG OFF)
find_package(catkin QUIET)
if(catkin_FOUND)
  set(missing "")
  foreach(component IN LISTS HEERK_ROS_COMPONENTS)
    find_package(${component} QUIET)
    if(NOT ${component}_FOUND)
      list(APPEND missing ${component})
    endif()
  endforeach()
  if(missing)
    message(WARNING "catkin is installed but not ${missing}: building without ROS; "
                    "scripts/install_dependencies.sh installs what is needed")
  else()
    set(HEERK_HAVE_ROS ON)
    find_package(rosbag QUIET)
    if(rosbag_FOUND)
      set(HEERK_HAVE_ROSBAG ON)
    endif()
    # Last, so that catkin_LIBRARIES holds these components only.
    find_package(catkin REQUIRED COMPONENTS ${HEERK_ROS_COMPONENTS})
  endif()
endif()

if(NOT CATKIN_DEVEL_PREFIX)
  set(CATKIN_DEVEL_PREFIX ${CMAKE_BINARY_DIR}/devel)
endif()
set(HEERK_PROGRAM_DIR ${CATKIN_DEVEL_PREFIX}/lib/${PROJECT_NAME})
if(NOT HEERK_HAVE_ROS)  # otherwise catkin_package() sets the same ones
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${HEERK_PROGRAM_DIR})
  set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/lib)
  set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/lib)
endif()

if(NOT PYTHON_EXECUTABLE)
  find_package(Python3 COMPONENTS Interpreter)
  set(PYTHON_EXECUTABLE ${Python3_EXECUTABLE})
endif()
set(HEERK_PYTHON ${PYTHON_EXECUTABLE})
message(STATUS "heerk_rotor: ROS ${HEERK_HAVE_ROS}, rosbag ${HEERK_HAVE_ROSBAG}")
