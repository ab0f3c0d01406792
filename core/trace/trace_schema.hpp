// SPDX-License-Identifier: MIT
// trace_schema.hpp: the fields of every record in text, which stands in the file as the schema of the channel, so that
// readers in other languages follow the file and not this program.
//
// A line is `name: fields`, or `name = kind: fields` of a record; a field is a type and a name. Types are numbers (u8,
// u16, u32, u64, i32, i64, f32, f64), names of earlier lines, whose fields then stand in place, without padding, and
//
//   clock                 i64 of nanoseconds that a clock measured: others at each run; clock_times.hpp finds them
//   text                  u32 count · UTF-8
//   array T               u32 count · the values
//   elements T            u32 count · u32 stride · the elements, each a T and what the contract appended to it
//   block T               u32 length · a T and what was appended to it
//   blocks T              u32 count · each as a block
//   optional block T      u8 0 or 1 · if 1, the block
//   optional T NAME*A*B   u8 0 or 1 · if 1, values, as many as the product of earlier fields and numbers
//
// trace_layout.hpp writes and reads these fields; tests/python compares what both say of a file.
#pragma once

namespace dmrp::core {

inline constexpr const char* trace_schema_name = "dmrp.Trace";
inline constexpr const char* trace_schema_encoding = "dmrpfields";
inline constexpr const char* trace_schema =
    "vec2: f64 x, f64 y\n"
    "pose: f64 x, f64 y, f64 theta\n"
    "twist: f64 v_x, f64 v_y, f64 omega\n"
    "segment: vec2 from, vec2 to\n"
    "goal: pose pose, f64 tolerance_m, f64 tolerance_rad, f64 tolerance_speed, i64 settle_ns\n"
    "waypoint: f64 x, f64 y, f64 theta, i64 t_ns, u32 goal_index, u32 reserved\n"
    "robot_sample: pose pose, twist velocity, twist command, u32 state, u32 goal_index, f64 progress_m, "
    "f64 steering_angle, twist answer, i32 answer_status, u32 reserved\n"
    "person: u64 id, u32 group, u32 target_id, vec2 position, vec2 velocity, f64 radius_m, f64 desired_speed, "
    "vec2 target, vec2 area_lower, vec2 area_upper, u32 reaction, u32 reserved\n"
    "contact: u32 kind, u32 flags, u32 a, u32 b, f64 depth_m, vec2 point, f64 impact_speed\n"
    "call: u32 kind, u32 robot, i32 status, u32 reserved, clock duration_ns\n"
    "robot_event: u32 kind, u32 robot, i64 t_ns, u32 detail, u32 other\n"
    "robot_end: u32 state, u32 failure, i64 arrival_ns, u32 visits, u32 culprit\n"
    "source: u32 plugin_kind, u32 robot\n"
    "limits: f64 v_min, f64 v_max, f64 v_y_max, f64 omega_max, f64 a_max, f64 alpha_max, f64 wheelbase_m, "
    "f64 steering_max, f64 steering_rate_max\n"
    "polygon: array vec2 vertices\n"
    "footprint: f64 radius_m, f64 inscribed_radius_m, blocks polygon parts\n"
    "robot: text name, text type, u32 kinematics, pose start, block limits limits, block footprint footprint, "
    "elements goal goals\n"
    "shape: text name, u32 kind, vec2 center, f64 radius_m, f64 height_m, array vec2 vertices\n"
    "grid: u32 width, u32 height, f64 resolution_m, vec2 origin, optional u8 free*width*height, "
    "optional u8 edges*width*height, optional f32 clearance*width*height\n"
    "path: u32 flags, elements waypoint waypoints\n"
    "route: u32 robot, u32 update_flags, u32 path_flags, u32 kept, elements waypoint waypoints\n"
    "statistic: text name, f64 value\n"
    "world = 1: u32 format_version, u32 person_count, vec2 lower, vec2 upper, i64 step_ns, i64 control_period_ns, "
    "i64 time_limit_ns, i64 call_budget_ns, f64 person_radius_m, blocks robot robots, blocks shape shapes, "
    "array segment segments, optional block grid planning_grid\n"
    "plan = 2: i64 made_at_ns, u64 revision, i64 from_ns, i64 step_duration_ns, clock planning_ns, clock processor_ns, "
    "i32 status, u32 conflicts, blocks path paths, blocks statistic statistics\n"
    "sample = 3: i64 t_ns, i64 dt_ns, u32 control_tick, u64 plan_revision, elements robot_sample robots, "
    "elements person people, elements contact contacts, elements call calls, elements robot_event events, "
    "blocks route routes\n"
    "trajectory = 4: i64 t_ns, source source, u32 role, i64 step_ns, array pose poses\n"
    "note = 5: i64 t_ns, source source, text text\n"
    "end = 6: u32 ending, i64 t_ns, elements robot_end robots, text reason\n"
    "scan = 7: i64 t_ns, u32 robot, f64 angle_min, f64 angle_increment, f64 range_min, f64 range_max, "
    "array f32 ranges\n";

}  // namespace dmrp::core
