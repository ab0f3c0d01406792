# SPDX-License-Identifier: MIT
# nav2_write_ros_headers(FOLDER): the headers of ROS by their names, each of which includes the shim's header.
set(nav2_messages
    builtin_interfaces/msg/{duration,time} dwb_msgs/msg/{critic_score,local_plan_evaluation,trajectory2_d,trajectory_score}
    geometry_msgs/msg/{point,point32,point_stamped,polygon,polygon_stamped,pose,pose2_d,pose_stamped,quaternion}
    geometry_msgs/msg/{transform_stamped,twist,twist_stamped,vector3} nav_msgs/msg/{occupancy_grid,odometry,path}
    nav2_msgs/msg/{critics_stats,trajectory,waypoint_status} nav_2d_msgs/msg/{path2_d,pose2_d_stamped,twist2_d}
    nav_2d_msgs/msg/{twist2_d_stamped} rcl_interfaces/msg/{parameter_descriptor,set_parameters_result}
    rcl_interfaces/srv/{list_parameters} sensor_msgs/msg/{point_cloud,point_cloud2} sensor_msgs/{point_cloud2_iterator}
    std_msgs/msg/{bool,color_rgba,header} visualization_msgs/msg/{marker,marker_array})
set(nav2_node rclcpp/{rclcpp,duration,time,clock,logger,logging,node,executors,parameter,parameter_value,publisher}
              rclcpp_lifecycle/{lifecycle_node,lifecycle_publisher})
set(nav2_transforms tf2/{convert,exceptions,time,transform_datatypes,utils} tf2_geometry_msgs/{tf2_geometry_msgs}
                    tf2_ros/{buffer,transform_broadcaster,transform_listener})
set(nav2_pluginlib pluginlib/{class_list_macros,class_loader,exceptions})
set(nav2_angles angles/{angles})

function(nav2_write_ros_headers folder)
  foreach(shim messages node transforms pluginlib angles)
    foreach(group IN LISTS nav2_${shim})
      string(REGEX MATCH "^(.*){(.*)}$" matched ${group})
      string(REPLACE "," ";" names ${CMAKE_MATCH_2})
      foreach(name IN LISTS names)
        foreach(ending hpp h)
          file(CONFIGURE OUTPUT ${folder}/${CMAKE_MATCH_1}${name}.${ending}
               CONTENT "#pragma once\n#include <nav2_shim/${shim}.hpp>\n")
        endforeach()
      endforeach()
    endforeach()
  endforeach()
endfunction()
