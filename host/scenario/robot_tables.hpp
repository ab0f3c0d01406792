// SPDX-License-Identifier: MIT
// robot_tables.hpp: the tables [robot] and [robot_type.NAME] of experiment and scenario files.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/scene/robot_types.hpp"
#include "host/scenario/read_scenario.hpp"
#include "host/toml/setting.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

inline constexpr const char* default_type_name = "default";  // of [robot], in a [[scenario]]'s `types`

// Reads [robot] or a [robot_type.NAME]; keys that are not given keep their values. `others`: tables that others read.
void read_robot_table(const TomlTable& table, core::RobotSettings& robot, const std::vector<std::string>& others = {});

// Every value of such a table, those of subtables as "lidar.beams".
Settings robot_values(core::RobotSettings& to);

// Refuses settings that do not fit together, at `table`. Throws InputError.
void check_robot(const TomlTable& table, core::RobotSettings& robot);

// The types of the experiment file; keys that are not given are those of [robot].
std::vector<core::RobotSettings> read_robot_types(const TomlTable& root, const core::RobotSettings& standard);

// The types that a scenario's robots can have: the default, those of its file, which take keys that are not given from
// the default, and those of the experiment, which replace types of the same name. Throws InputError for an unknown type.
core::RobotTypes robot_types_of(const ScenarioFile& file, const core::RobotSettings& standard,
                                std::span<const core::RobotSettings> of_experiment);

[[noreturn]] void fail_unknown_type(const TomlValue& at, const core::RobotTypes& types);  // the key of `at`

const char* shown_drive(core::Drive drive);  // "a differential drive"

// The keys of such a table and of its subtables; `table`: its title without the last bracket.
std::vector<TomlKeys> robot_table_keys(const std::string& table);

// Lines of key = value.
std::string robot_text(const core::RobotSettings& robot);

}  // namespace dmrp::host
