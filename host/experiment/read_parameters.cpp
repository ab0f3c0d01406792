// SPDX-License-Identifier: MIT
#include "host/experiment/read_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/errors/mistakes.hpp"
#include "host/files/read_file.hpp"
#include "host/program/executable.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_variants = 1000;

fs::path parameter_set_folder() {
  return shared_data_path() / "parameter_sets";
}

std::string unit_of(const ParameterSpec& spec) {
  return spec.unit.empty() || spec.unit == "1" ? "" : " " + spec.unit;
}

void check_range(const TomlValue& value, const ParameterSpec& spec, double number) {
  if (number >= spec.minimum && number <= spec.maximum) return;
  const std::string unit = unit_of(spec);
  if (std::isinf(spec.maximum))
    value.fail(fmt::format("'{}' must be at least {}{}, not {}", value.key(), spec.minimum, unit, number));
  if (std::isinf(spec.minimum))
    value.fail(fmt::format("'{}' must be at most {}{}, not {}", value.key(), spec.maximum, unit, number));
  value.fail(
      fmt::format("'{}' must be from {} to {}{}, not {}", value.key(), spec.minimum, spec.maximum, unit, number));
}

// Resolves a path. A default is not resolved, because it need not name a file.
std::string resolve(const TomlValue& value, const ParameterSpec& spec, const fs::path& base) {
  if (value.text() == spec.fallback.text) return value.text();
  const fs::path path = base / value.text();
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored))
    value.fail(fmt::format("'{}' names no file: '{}'", value.key(), value.text()));
  return fs::canonical(path).string();
}

ParameterValue read_value(const TomlValue& value, const ParameterSpec& spec, const fs::path& base) {
  if (value.is_array() && spec.fallback.type != DMRP_PARAM_DOUBLE_ARRAY &&
      spec.fallback.type != DMRP_PARAM_STRING_ARRAY)
    value.fail(fmt::format(
        "'{0}' must be one value, not an array (for variants, the experiment has sweep = {{ {0} = [...] }})",
        value.key()));
  ParameterValue out;
  out.key = spec.fallback.key;
  out.type = spec.fallback.type;
  switch (out.type) {
    case DMRP_PARAM_BOOL:
      out.integer = value.boolean();
      break;
    case DMRP_PARAM_INT:
      out.integer = value.integer();
      check_range(value, spec, static_cast<double>(out.integer));
      break;
    case DMRP_PARAM_DOUBLE:
      out.number = value.number();
      check_range(value, spec, out.number);
      break;
    case DMRP_PARAM_STRING:
      out.text = value.text();
      break;
    case DMRP_PARAM_CHOICE:
      out.text = value.choice(spec.choices);
      break;
    case DMRP_PARAM_PATH:
      out.text = resolve(value, spec, base);
      break;
    case DMRP_PARAM_DOUBLE_ARRAY:
      for (const TomlValue& element : value.array()) {
        out.numbers.push_back(element.number());
        check_range(element, spec, out.numbers.back());
      }
      break;
    case DMRP_PARAM_STRING_ARRAY:
      for (const TomlValue& element : value.array()) out.texts.push_back(element.text());
      break;
    default:
      value.fail(fmt::format("'{}' has a type that this host does not know", value.key()));
  }
  return out;
}

// Reads the entries of `params` or `sweep` in the order of the file, each with the index of its declared parameter.
void read_declared(const TomlTable& table, const PluginInfo& info,
                   const std::function<void(const TomlValue&, std::size_t)>& read) {
  std::vector<std::string> known;
  for (const ParameterSpec& spec : info.parameters) known.push_back(spec.fallback.key);
  Mistakes mistakes;
  mistakes.attempt([&] { table.allow_only(known, " for " + info.id); });
  for (const TomlValue& entry : table.entries())
    if (const auto found = std::find(known.begin(), known.end(), entry.key()); found != known.end())
      mistakes.attempt([&] { read(entry, static_cast<std::size_t>(found - known.begin())); });
  mistakes.end();
}

std::string text_of(const ParameterValue& value) {
  switch (value.type) {
    case DMRP_PARAM_BOOL:
      return value.integer ? "on" : "off";
    case DMRP_PARAM_INT:
      return fmt::format("{}", value.integer);
    case DMRP_PARAM_DOUBLE:
      return fmt::format("{}", value.number);
    case DMRP_PARAM_PATH:
      return fs::path(value.text).filename().string();
    case DMRP_PARAM_DOUBLE_ARRAY:
      return fmt::format("[{}]", fmt::join(value.numbers, ", "));
    case DMRP_PARAM_STRING_ARRAY:
      return fmt::format("[{}]", fmt::join(value.texts, ", "));
    default:
      return value.text;
  }
}

// The product of the variants with the values of another swept key.
std::vector<ParameterVariant> multiply(const std::vector<ParameterVariant>& variants, std::size_t index,
                                       const std::vector<ParameterValue>& values, const std::string& table) {
  std::vector<ParameterVariant> out;
  for (const ParameterVariant& variant : variants)
    for (const ParameterValue& value : values) {
      ParameterVariant next = variant;
      next.values[index] = value;
      next.swept.push_back({table, value.key, text_of(value)});
      out.push_back(std::move(next));
    }
  return out;
}

// The values of a swept key, with different labels.
std::vector<ParameterValue> read_sweep(const TomlValue& entry, const ParameterSpec& spec, const fs::path& base) {
  std::vector<ParameterValue> values;
  for (const TomlValue& element : entry.array()) {
    ParameterValue value = read_value(element, spec, base);
    for (const ParameterValue& other : values)
      if (text_of(other) == text_of(value))
        element.fail(fmt::format("'{} {}' twice in a sweep", value.key, text_of(value)));
    values.push_back(std::move(value));
  }
  if (values.empty()) entry.fail(fmt::format("'{}' sweeps over no values", entry.key()));
  return values;
}

}  // namespace

fs::path parameter_set(const std::string& name, const fs::path& base) {
  for (const fs::path& folder : {base, parameter_set_folder()})
    if (std::error_code ignored; fs::is_regular_file(folder / name, ignored)) return fs::canonical(folder / name);
  return {};
}

// Paths relative to the folder of parameter sets.
std::vector<std::string> shipped_parameter_sets() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(parameter_set_folder(), ignored))
    if (entry.is_regular_file(ignored)) names.push_back(entry.path().lexically_relative(parameter_set_folder()));
  std::sort(names.begin(), names.end());
  return names;
}

std::string shipped_set_of(const fs::path& file) {
  if (file.empty()) return "";
  const fs::path within = file.lexically_relative(fs::weakly_canonical(parameter_set_folder()));
  return within.empty() || *within.begin() == ".." ? "" : file.parent_path().filename().string();
}

fs::path find_parameter_file(const TomlTable& use, const fs::path& base) {
  const auto value = use.find("params_file");
  if (!value) return {};
  const std::string name = value->line();
  if (fs::path file = parameter_set(name, base); !file.empty()) return file;
  const std::vector<std::string> shipped = shipped_parameter_sets();
  value->fail(fmt::format("no parameter file '{}' beside the experiment file{} (shipped: {})", name,
                          did_you_mean(name, shipped), join_names(shipped)));
}

std::vector<ParameterVariant> read_parameters(const TomlTable& use, const PluginInfo& info, const fs::path& base,
                                              const fs::path& file) {
  std::vector<ParameterVariant> variants(1);
  for (const ParameterSpec& spec : info.parameters) variants[0].values.push_back(spec.fallback);
  Mistakes mistakes;
  mistakes.attempt([&] {
    if (file.empty()) return;
    const TomlDocument document(shown(file), read_file(file, shown(file)));
    read_declared(document.root(), info, [&](const TomlValue& entry, std::size_t index) {
      variants[0].values[index] = read_value(entry, info.parameters[index], file.parent_path());
    });
  });
  std::vector<bool> set(info.parameters.size());
  mistakes.attempt([&] {
    const auto params = use.find_table("params");
    if (!params) return;
    read_declared(*params, info, [&](const TomlValue& entry, std::size_t index) {
      set[index] = true;
      variants[0].values[index] = read_value(entry, info.parameters[index], base);
    });
  });
  mistakes.attempt([&] {
    const auto sweep = use.find_table("sweep");
    if (!sweep) return;
    read_declared(*sweep, info, [&](const TomlValue& entry, std::size_t index) {
      if (set[index]) entry.fail_at_key(fmt::format("'{}' is already set in 'params'", entry.key()));
      const auto values = read_sweep(entry, info.parameters[index], base);
      if (variants.size() * values.size() > max_variants)
        entry.fail(fmt::format("the sweep has more than {} variants", max_variants));
      variants = multiply(variants, index, values, kind_name(info.kind));
    });
  });
  mistakes.end();
  return variants;
}

}  // namespace dmrp::host
