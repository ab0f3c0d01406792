# SPDX-License-Identifier: MIT
# The target `nav2`: nav2's files, from NAV2_SOURCE_DIR as they are, with the shim; and the variable nav2_version.
if(NOT EXISTS "${NAV2_SOURCE_DIR}/nav2_core/include/nav2_core/controller.hpp")
  message(FATAL_ERROR "NAV2_SOURCE_DIR is no source folder of nav2: '${NAV2_SOURCE_DIR}'. Give it by "
                      "-DNAV2_SOURCE_DIR=.../navigation2")
endif()
find_package(Eigen3 REQUIRED)
find_package(Threads REQUIRED)

file(READ ${NAV2_SOURCE_DIR}/nav2_core/package.xml package)
string(REGEX MATCH "<version>([^<]+)</version>" matched "${package}")
set(nav2_version ${CMAKE_MATCH_1})

# As nav2 builds MPPI: -O3, and fused multiply-add where the compiler has it. All files alike, because the alignment of
# Eigen's arrays follows from these flags.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-mfma has_fma)
add_compile_options(-O3 -ffp-contract=off -fvisibility=hidden -fPIC)
if(has_fma)
  add_compile_options(-mfma)
endif()

# nav2's files, where they are
set(nav2_files
    nav2_costmap_2d/src/{costmap_2d,costmap_math,footprint,footprint_collision_checker,layer,layered_costmap}
    nav2_util/src/{array_parser}
    nav2_mppi_controller/src/{controller,critic_manager,noise_generator,optimizer,parameters_handler,path_handler}
    nav2_mppi_controller/src/{trajectory_visualizer}
    nav2_mppi_controller/src/critics/{constraint_critic,cost_critic,goal_angle_critic,goal_critic,obstacles_critic}
    nav2_mppi_controller/src/critics/{path_align_critic,path_angle_critic,path_follow_critic,prefer_forward_critic}
    nav2_mppi_controller/src/critics/{twirling_critic,velocity_deadband_critic}
    nav2_regulated_pure_pursuit_controller/src/{collision_checker,parameter_handler,path_handler}
    nav2_regulated_pure_pursuit_controller/src/{regulated_pure_pursuit_controller}
    nav2_graceful_controller/src/{graceful_controller,parameter_handler,path_handler,smooth_control_law,utils}
    nav2_dwb_controller/nav_2d_utils/src/{conversions,path_ops,tf_help}
    nav2_dwb_controller/costmap_queue/src/{costmap_queue,limited_costmap_queue}
    nav2_dwb_controller/dwb_core/src/{dwb_local_planner,illegal_trajectory_tracker,publisher,trajectory_utils}
    nav2_dwb_controller/dwb_critics/src/{alignment_util,base_obstacle,goal_align,goal_dist,map_grid,obstacle_footprint}
    nav2_dwb_controller/dwb_critics/src/{oscillation,path_align,path_dist,prefer_forward,rotate_to_goal,twirling}
    nav2_dwb_controller/dwb_plugins/src/{kinematic_parameters,limited_accel_generator,standard_traj_generator}
    nav2_dwb_controller/dwb_plugins/src/{xy_theta_iterator})
set(nav2_sources "")
foreach(group IN LISTS nav2_files)
  string(REGEX MATCH "^(.*){(.*)}$" matched ${group})
  string(REPLACE "," ";" names ${CMAKE_MATCH_2})
  foreach(name IN LISTS names)
    list(APPEND nav2_sources ${NAV2_SOURCE_DIR}/${CMAKE_MATCH_1}${name}.cpp)
  endforeach()
endforeach()
file(GLOB nav2_includes LIST_DIRECTORIES true ${NAV2_SOURCE_DIR}/*/include ${NAV2_SOURCE_DIR}/*/*/include)

include(ros_headers.cmake)
nav2_write_ros_headers(${CMAKE_BINARY_DIR}/ros_headers)

# The shim comes before nav2: two of nav2's headers have a stand-in.
add_library(nav2 OBJECT ${nav2_sources} shim/nav2_costmap_2d/costmap_2d_ros.cpp ${NAV2_MY_SOURCES})
target_include_directories(nav2 PUBLIC shim ${CMAKE_BINARY_DIR}/ros_headers ${nav2_includes} ${NAV2_MY_INCLUDES})
target_link_libraries(nav2 PUBLIC Eigen3::Eigen Threads::Threads)
target_compile_options(nav2 PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fconcepts>)

# nav2's own unit tests of MPPI, as they are, against the shim.
if(NAV2_TESTS)
  enable_testing()
  find_package(GTest REQUIRED)
  foreach(test controller_state_transition_test critic_manager_test critics_tests models_test motion_model_tests
               noise_generator_test optimizer_smoke_test optimizer_unit_tests parameter_handler_test path_handler_test
               trajectory_visualizer_tests utils_test)
    add_executable(${test} ${NAV2_SOURCE_DIR}/nav2_mppi_controller/test/${test}.cpp)
    target_link_libraries(${test} PRIVATE nav2 GTest::gtest)
    target_compile_options(${test} PRIVATE -O1) # they compile for long enough
    # a header of MPPI defines a function: one copy in the test, one in a library, which is no error between libraries
    target_link_options(${test} PRIVATE -Wl,-z,muldefs)
    add_test(NAME ${test} COMMAND ${test})
  endforeach()
endif()
