// SPDX-License-Identifier: MIT
#include "host/scenario/read_crowd.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/errors/mistakes.hpp"
#include "host/scenario/scenario_values.hpp"
#include "host/toml/nearest_name.hpp"
#include "host/toml/setting.hpp"

namespace dmrp::host {
namespace {

constexpr std::int64_t max_people_of_flow = 10'000;  // of a flow
const std::vector<std::string> start_choices = {"along", "from"};
// In the order of DMRP_REACTION_*.
const std::vector<std::string> reaction_choices = {"unspecified", "regular", "impassive",  "surprised",
                                                   "curious",     "scared",  "threatening"};

Settings people_settings(core::PeopleSettings& to) {
  return {positive("radius_m", to.radius_m, 10.0), positive("speed_mean", to.speed_mean, 100.0),
          number("speed_sd", to.speed_sd, 0.0, 100.0), positive("speed_min", to.speed_min, 100.0),
          positive("speed_max", to.speed_max, 100.0)};
}

void read_people(const TomlTable& root, core::PeopleSettings& people) {
  const auto table = root.find_table("people");
  if (!table) return;
  table->read(readers_of(people_settings(people)));
  if (people.speed_min > people.speed_mean || people.speed_mean > people.speed_max)
    table->fail(fmt::format("[people] needs speed_min <= speed_mean <= speed_max, not {}, {}, {}", people.speed_min,
                            people.speed_mean, people.speed_max));
}

// `names`: of the regions that can be named in flows, also of those with other mistakes.
void read_regions(const TomlTable& root, std::vector<std::string>& names, ScenarioFile& out) {
  root.read_tables("region", [&](const TomlTable& table) {
    core::Region region;
    Mistakes mistakes;
    mistakes.attempt([&] { table.allow_only_keys(region_keys()); });
    mistakes.attempt([&] {
      const TomlValue name = table.need("name");
      region.name = name.line();
      refuse_twice(name, "regions", names);
      names.push_back(region.name);
    });
    mistakes.attempt([&] { region.lower = point(table.need("lower_m")); });
    mistakes.attempt([&] { region.upper = point(table.need("upper_m")); });
    mistakes.end();
    if (region.lower.x > region.upper.x || region.lower.y > region.upper.y)
      table.fail(fmt::format("region '{}' needs lower_m <= upper_m", region.name));
    out.scenario.regions.push_back(region);
    out.regions.push_back(table.position());
  });
}

std::uint32_t region_index(const TomlValue& value, const std::vector<std::string>& names) {
  const std::string name = value.text();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) value.fail(fmt::format("no region '{}'{}", name, among(name, names)));
  return static_cast<std::uint32_t>(found - names.begin());
}

// A flow without people has no groups, so its group size is not limited.
std::uint32_t read_group_size(const TomlValue& value, const core::Flow& flow) {
  const auto size = static_cast<std::uint32_t>(value.integer(1, max_people_of_flow));
  if (flow.people > 0 && size > flow.people)
    value.fail(fmt::format("'group_size' must be at most 'people', {}, not {}", flow.people, size));
  return size;
}

// The regions that a flow leads through, in this order. `regions`: all names; `first_own`: the index of the first.
std::vector<std::uint32_t> read_way(const TomlTable& table, const std::string& flow,
                                    const std::vector<std::string>& regions, std::uint32_t first_own) {
  std::vector<std::uint32_t> way;
  Mistakes mistakes;
  const auto add = [&](const TomlValue& region) {
    const std::uint32_t next = first_own + region_index(region, regions);
    if (!way.empty() && next == way.back())
      region.fail(fmt::format("flow '{}' leads from region '{}' to itself: nobody would walk", flow, region.text()));
    way.push_back(next);
  };
  mistakes.attempt([&] { add(table.need("from")); });
  mistakes.attempt([&] {
    if (const auto via = table.find("via"))
      for (const TomlValue& region : via->array()) add(region);
  });
  mistakes.attempt([&] { add(table.need("to")); });
  mistakes.end();
  return way;
}

void read_flows(const TomlTable& root, const std::vector<std::string>& regions, ScenarioFile& out) {
  const auto first_own = static_cast<std::uint32_t>(out.scenario.regions.size() - regions.size());  // after tiles'
  std::vector<std::string> names;
  root.read_tables("flow", [&](const TomlTable& table) {
    core::Flow flow;
    Mistakes mistakes;
    mistakes.attempt([&] { table.allow_only_keys(flow_keys()); });
    mistakes.attempt([&] {
      const auto name = table.find("name");
      flow.name = name ? name->line() : fmt::format("flow {}", names.size() + 1);
      if (name) refuse_twice(*name, "flows", names);
      names.push_back(flow.name);
    });
    mistakes.attempt([&] { flow.regions = read_way(table, flow.name, regions, first_own); });
    mistakes.attempt([&] {
      flow.people = static_cast<std::uint32_t>(table.need("people").integer(0, max_people_of_flow));
      if (const auto size = table.find("group_size")) flow.group_size = read_group_size(*size, flow);
    });
    mistakes.attempt([&] {
      if (const auto start = table.find("start"); start && start->choice(start_choices) == "from")
        flow.start = core::FlowStart::from;
    });
    mistakes.attempt([&] {
      if (const auto respawn = table.find("respawn")) flow.respawn = respawn->boolean();
    });
    mistakes.attempt([&] {
      if (const auto reaction = table.find("reaction"))
        flow.reaction = static_cast<std::uint32_t>(
            std::find(reaction_choices.begin(), reaction_choices.end(), reaction->choice(reaction_choices)) -
            reaction_choices.begin());
    });
    mistakes.end();
    out.scenario.flows.push_back(std::move(flow));
    out.flows.push_back(table.position());
  });
}

}  // namespace

TomlKeys people_keys() {
  core::PeopleSettings standard;
  return keys_of("[people]", people_settings(standard));
}

std::vector<TomlKey> region_keys() {
  return {{"name"}, {"lower_m", point_range()}, {"upper_m", point_range()}};
}

std::vector<TomlKey> flow_keys() {
  return {{"name"},
          {"from"},
          {"via"},
          {"to"},
          {"people", range_text(0, max_people_of_flow)},
          {"start", choices_text(start_choices)},
          {"respawn", boolean_text},
          {"group_size", range_text(1, max_people_of_flow)},
          {"reaction", choices_text(reaction_choices)}};
}

void read_crowd(const TomlTable& root, ScenarioFile& out) {
  Mistakes mistakes;
  mistakes.attempt([&] { read_people(root, out.scenario.people); });
  std::vector<std::string> regions;
  mistakes.attempt([&] { read_regions(root, regions, out); });
  mistakes.attempt([&] {
    const bool has_all_names = regions.size() == root.tables("region").size();
    if (has_all_names) read_flows(root, regions, out);
  });
  mistakes.end();
}

}  // namespace dmrp::host
