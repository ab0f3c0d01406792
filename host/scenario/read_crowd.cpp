// SPDX-License-Identifier: MIT
#include "host/scenario/read_crowd.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/scenario/scenario_values.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {
namespace {

constexpr std::int64_t max_people = 10'000;  // of a flow

std::vector<TomlTable::KeyReader> people_readers(core::PeopleSettings& people) {
  const auto read_positive = [](double& to, double maximum) {
    return [&to, maximum](const TomlValue& value) { to = positive(value, maximum); };
  };
  return {{"radius_m", read_positive(people.radius_m, 10.0)},
          {"speed_mean", read_positive(people.speed_mean, 100.0)},
          {"speed_sd", [&people](const TomlValue& value) { people.speed_sd = value.number(0.0, 100.0); }},
          {"speed_min", read_positive(people.speed_min, 100.0)},
          {"speed_max", read_positive(people.speed_max, 100.0)}};
}

void read_people(const TomlTable& root, core::PeopleSettings& people) {
  const auto table = root.find_table("people");
  if (!table) return;
  table->read(people_readers(people));
  if (people.speed_min > people.speed_mean || people.speed_mean > people.speed_max)
    table->fail(fmt::format("[people] needs speed_min <= speed_mean <= speed_max, not {}, {}, {}", people.speed_min,
                            people.speed_mean, people.speed_max));
}

std::vector<std::string> read_regions(const TomlTable& root, ScenarioFile& out) {
  std::vector<std::string> names;
  for (const TomlTable& table : root.tables("region")) {
    table.allow_only(region_keys);
    core::Region region;
    const TomlValue name = table.need("name");
    region.name = name.line();
    refuse_twice(name, "regions", names);
    region.lower = point(table.need("lower_m"));
    region.upper = point(table.need("upper_m"));
    if (region.lower.x > region.upper.x || region.lower.y > region.upper.y)
      table.fail(fmt::format("region '{}' needs lower_m <= upper_m", region.name));
    names.push_back(region.name);
    out.scenario.regions.push_back(region);
    out.regions.push_back(table.position());
  }
  return names;
}

std::uint32_t region_index(const TomlValue& value, const std::vector<std::string>& names) {
  const std::string name = value.text();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    value.fail(fmt::format("no region '{}' (there: {}){}", name, join_names(names), did_you_mean(name, names)));
  return static_cast<std::uint32_t>(found - names.begin());
}

// A flow without people has no groups, so its group size is not limited.
std::uint32_t read_group_size(const TomlValue& value, const core::Flow& flow) {
  const auto size = static_cast<std::uint32_t>(value.integer(1, max_people));
  if (flow.people > 0 && size > flow.people)
    value.fail(fmt::format("'group_size' must be at most 'people', {}, not {}", flow.people, size));
  return size;
}

void read_flows(const TomlTable& root, const std::vector<std::string>& regions, ScenarioFile& out) {
  const auto first_own = static_cast<std::uint32_t>(out.scenario.regions.size() - regions.size());  // after tiles'
  const auto region_of = [&](const TomlValue& value) { return first_own + region_index(value, regions); };
  std::vector<std::string> names;
  for (const TomlTable& table : root.tables("flow")) {
    table.allow_only(flow_keys);
    core::Flow flow;
    const TomlValue name = table.need("name");
    flow.name = name.line();
    refuse_twice(name, "flows", names);
    names.push_back(flow.name);
    flow.regions.push_back(region_of(table.need("from")));
    const auto lead_to = [&](const TomlValue& region) {
      const std::uint32_t next = region_of(region);
      if (next == flow.regions.back())
        region.fail(
            fmt::format("flow '{}' leads from region '{}' to itself: nobody would walk", flow.name, region.text()));
      flow.regions.push_back(next);
    };
    if (const auto via = table.find("via"))
      for (const TomlValue& region : via->array()) lead_to(region);
    lead_to(table.need("to"));
    flow.people = static_cast<std::uint32_t>(table.need("people").integer(0, max_people));
    if (const auto start = table.find("start"); start && start->choice({"along", "from"}) == "from")
      flow.start = core::FlowStart::from;
    if (const auto respawn = table.find("respawn")) flow.respawn = respawn->boolean();
    if (const auto size = table.find("group_size")) flow.group_size = read_group_size(*size, flow);
    out.scenario.flows.push_back(std::move(flow));
    out.flows.push_back(table.position());
  }
}

}  // namespace

std::vector<std::string> people_keys() {
  core::PeopleSettings unused;
  return TomlTable::keys_of(people_readers(unused));
}

void read_crowd(const TomlTable& root, ScenarioFile& out) {
  read_people(root, out.scenario.people);
  const auto regions = read_regions(root, out);
  read_flows(root, regions, out);
}

}  // namespace dmrp::host
