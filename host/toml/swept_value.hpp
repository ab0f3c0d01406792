// SPDX-License-Identifier: MIT
// swept_value.hpp: a value of a key that an experiment gives a list of values.
#pragma once

#include <span>
#include <string>

namespace dmrp::host {

struct SweptValue {
  std::string table;  // of settings: "simulation"; a plugin's: "local_controller"; "": of a [[scenario]]
  std::string key;
  std::string value;  // numbers in their shortest exact form, texts without quotes

  bool operator==(const SweptValue&) const = default;
};

// Its column in results: "simulation.tracking", "people".
inline std::string column_of(const SweptValue& swept) {
  return swept.table.empty() ? swept.key : swept.table + "." + swept.key;
}

// Whether it is part of a plugin's label, not of the scenario's name.
inline bool is_of_plugin(const SweptValue& swept) {
  return swept.table == "global_planner" || swept.table == "local_controller" || swept.table == "pedestrian_model";
}

// A name with the swept values: "mall (people 12, tracking none)".
inline std::string with_swept(const std::string& name, std::span<const SweptValue> swept) {
  std::string values;
  for (const SweptValue& one : swept) values += (values.empty() ? "" : ", ") + one.key + " " + one.value;
  return values.empty() ? name : name + " (" + values + ")";
}

}  // namespace dmrp::host
