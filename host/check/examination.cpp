// SPDX-License-Identifier: MIT
#include "host/check/examination.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace dmrp::host {

Examination::Examination(std::filesystem::path file, const PluginInfo* plugin, std::uint64_t seed, CallNote& note,
                         std::function<void(const std::string&)> progress)
    : file_(std::move(file)), plugin_(plugin), seed_(seed), guard_(note), progress_(std::move(progress)) {}

Examination::~Examination() {
  try {
    deinit();
  } catch (const PluginFault& fault) {
    fail(fault.text());
  }
}

const Library& Examination::library() {
  if (!library_) library_.emplace(file_);
  return *library_;
}

void Examination::init() {
  if (host_) return;
  library();
  host_ = std::make_unique<PluginHost>(
      "library", library_->file().string(), std::vector<std::string>(), guard_,
      [this](std::int32_t level, const std::string&, const std::string& text) { log(level, text); });
  guard_.call(host_->c(), {"library", "init"}, init_budget_ns, Answers::no_other,
              [&] { return library_->init(host_->c()); });
}

void Examination::deinit() {
  if (!host_) return;
  const std::unique_ptr<PluginHost> host = std::exchange(host_, nullptr);
  guard_.call(host->c(), {"library", "deinit"}, init_budget_ns, Answers::no_other,
              [&] { return library_->deinit(), DMRP_OK; });
}

std::vector<ParameterValue> Examination::defaults() const {
  std::vector<ParameterValue> values;
  for (const ParameterSpec& spec : plugin_->parameters) values.push_back(spec.fallback);
  return values;
}

std::unique_ptr<Instance> Examination::create() {
  return create(defaults());
}

std::unique_ptr<Instance> Examination::create_for(std::uint32_t robot) {
  return create(defaults(), guard_, 0, robot);
}

std::unique_ptr<Instance> Examination::create(const std::vector<ParameterValue>& parameters) {
  return create(parameters, guard_);
}

std::unique_ptr<Instance> Examination::create(const std::vector<ParameterValue>& parameters, CallGuard& guard,
                                              std::uint32_t grown_bytes, std::uint32_t robot) {
  init();
  PluginUse use;
  use.info = *plugin_;
  use.label = plugin_->id;
  use.parameters = parameters;
  const bool drives_one = plugin_->kind == DMRP_KIND_LOCAL_CONTROLLER && !plugin_->has_flag(DMRP_FLAG_CENTRAL);
  return std::make_unique<Instance>(
      *library_, use, drives_one ? static_cast<std::int32_t>(robot) : DMRP_NO_ROBOT, guard,
      [this](std::int32_t level, const std::string&, const std::string& text) { log(level, text); }, grown_bytes);
}

void Examination::at(const std::string& what) {
  at_ = what;
  progress_(what);
}

void Examination::find(CheckResult result, const std::string& text) {
  result_ = std::max(result_, result);
  if (!text_.empty()) text_ += "; ";
  text_ += at_.empty() ? text : at_ + ": " + text;
}

void Examination::log(std::int32_t level, const std::string& text) {
  const std::lock_guard lock(log_mutex_);
  if (level == DMRP_LOG_WARNING || level == DMRP_LOG_ERROR) complaints_.push_back(text);
}

std::vector<std::string> Examination::complaints() const {
  const std::lock_guard lock(log_mutex_);
  return complaints_;
}

namespace {

// The first difference of the outputs, to the bit; "" if there is none.
std::string difference(const Outputs& outputs, const Outputs& expected) {
  for (std::size_t i = 0; i < std::min(outputs.size(), expected.size()); ++i)
    if (std::memcmp(&outputs[i], &expected[i], sizeof(double)) != 0)
      return fmt::format("number {} of {} that it gives is {} instead of {}", i + 1, expected.size(), outputs[i],
                         expected[i]);
  if (outputs.size() != expected.size())
    return fmt::format("gives {} numbers instead of {}", outputs.size(), expected.size());
  return "";
}

}  // namespace

void expect_same(Examination& it, const Outputs& outputs, const Outputs& expected) {
  if (const auto timing = it.guard().timing(); !timing.empty())
    throw Skipped{"it says that its results depend on timing: " + timing.front().text};
  if (const std::string text = difference(outputs, expected); !text.empty()) it.fail(text);
}

Outputs alone(Examination& it, std::uint64_t seed) {
  const auto instance = it.create();
  return rehearse(*instance, it.plugin(), {}, seed);
}

Outputs rehearse_on(Examination& it, const StageSettings& settings) {
  const auto instance = it.create();
  return rehearse(*instance, it.plugin(), settings, it.seed());
}

}  // namespace dmrp::host
