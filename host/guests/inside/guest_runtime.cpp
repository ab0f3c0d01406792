// SPDX-License-Identifier: MIT
#include "host/guests/inside/guest_runtime.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/guests/exchange/plan_message.hpp"
#include "host/guests/inside/measure.hpp"
#include "host/plans/planning.hpp"
#include "host/results/result_json.hpp"

namespace dmrp::host {

GuestRuntime::GuestRuntime(std::string written, std::filesystem::path file, CallNote& note, CallGuard& guard,
                           LogSink log, Ask ask, Spool spool)
    : written_(std::move(written)),
      file_(std::move(file)),
      note_(note),
      guard_(guard),
      log_(std::move(log)),
      ask_(std::move(ask)),
      spool_(std::move(spool)) {}

GuestRuntime::~GuestRuntime() {
  try {
    unload();
  } catch (const PluginFault& fault) {
    log_(DMRP_LOG_ERROR, "library", fault.function() + ": " + fault.what());
  }
}

std::string GuestRuntime::answer(const GuestRequest& request, const std::string& text) {
  annotations_.bytes.clear();
  annotations_.wanted = request.annotated != 0;
  switch (request.task) {
    case GuestTask::load:
      load();
      return "";
    case GuestTask::probe:
      return probe();
    case GuestTask::begin_trial:
      trial_ = *static_cast<const BeginInput*>(request.input);
      trace_grids_.reset();
      trace_.reset();
      guard_.reset_timing();
      return "";
    case GuestTask::create:
      create(request.instance, text);
      return "";
    case GuestTask::start:
      start(request);
      return "";
    case GuestTask::control_all:
      control_all(request);
      return "";
    case GuestTask::move_people:
      move_people(request);
      return "";
    case GuestTask::plan:
      return plan(request);
    case GuestTask::end_trial:
      handle(request.instance)
          .instance->end_trial(*static_cast<const dmrp_trial_end*>(request.input), request.step, request.budget_ns);
      guard_.check_no_children();
      return "";
    case GuestTask::measure:
      return measure(request);
    case GuestTask::timing:
      return timing();
    case GuestTask::destroy:
      handles_.clear();
      return "";
    case GuestTask::unload:
      unload();
      return "";
  }
  return "";
}

void GuestRuntime::load() {
  library_ = std::make_unique<Library>(file_);
  library_host_ =
      std::make_unique<PluginHost>("library", library_->file().string(), std::vector<std::string>(), guard_, log_);
  guard_.call(library_host_->c(), {written_, "init", 0, -1}, init_budget_ns, Answers::no_other,
              [&] { return library_->init(library_host_->c()); });
}

std::string GuestRuntime::probe() {
  const auto note_stage = [this](const std::string& stage) {
    note_.function.fill('\0');
    stage.copy(note_.function.data(), note_.function.size() - 1);
  };
  const Library library(file_, note_stage);
  note_stage("init()");
  std::string init_error;
  try {
    const PluginHost host("library", library.file().string(), {}, guard_, log_);
    guard_.call(host.c(), {"library", "init()"}, init_budget_ns, Answers::no_other,
                [&] { return library.init(host.c()); });
    library.deinit();
  } catch (const PluginFault& fault) {
    init_error = std::string("its init() failed: ") + fault.what();
  }
  return nlohmann::json{{"plugins", library.plugins()},
                        {"warnings", library.warnings()},
                        {"objects", library.objects()},
                        {"init_error", init_error},
                        {"runtime", library.runtime()}}
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void GuestRuntime::unload() {
  handles_.clear();
  if (!library_host_) return;
  guard_.call(library_host_->c(), {"library", "deinit", 0, -1}, init_budget_ns, Answers::no_other,
              [&] { return library_->deinit(), DMRP_OK; });
  library_host_.reset();
}

void GuestRuntime::create(std::uint32_t number, const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text);
  const auto id = json.at("plugin").get<std::string>();
  const auto& plugins = library_->plugins();
  const auto info = std::find_if(plugins.begin(), plugins.end(), [&](const PluginInfo& one) { return one.id == id; });
  if (info == plugins.end())
    throw PluginFault(fault_kind::abi_breach, {id, "create"}, "the library has lost this plugin");
  PluginUse use;
  use.info = *info;
  use.parameters = json.at("parameters").get<std::vector<ParameterValue>>();
  InstanceHandle made;
  made.info = &*info;
  made.instance = std::make_unique<Instance>(*library_, use, json.at("robot").get<std::int32_t>(), guard_, log_);
  InstanceHandle& handle = handles_[number] = std::move(made);
  offer(number, handle);
}

void GuestRuntime::offer(std::uint32_t number, InstanceHandle& handle) {
  handle.annotations = std::make_unique<Annotations>(annotations_, number);
  if (handle.info->kind == DMRP_KIND_LOCAL_CONTROLLER)
    handle.sensors = std::make_unique<SensorReadings>(
        [this, number](GuestQuestion::Kind kind, std::uint32_t robot) { return reading(number, kind, robot); });
  handle.instance->offer([this, &handle](std::string_view id) -> const void* {
    if (id == DMRP_EXT_ANNOTATE && handle.info->kind != DMRP_KIND_METRIC) return handle.annotations->extension();
    if (handle.sensors) return handle.sensors->extension(id);
    return id == DMRP_EXT_WALKING_GRID && handle.grids ? handle.grids->extension(&guard_) : nullptr;
  });
}

std::shared_ptr<WalkingGrids> GuestRuntime::walking_grids(const SentScene& scene) {
  std::shared_ptr<WalkingGrids>& grids = scene.world ? walking_grids_[scene.world] : trace_grids_;
  if (grids) return grids;
  grids = std::make_shared<WalkingGrids>(scene.world ? *scene.world : trace_->world());
  for (std::uint32_t i = 0; i < scene.grid_count; ++i) grids->add(scene.grids[i]);
  return grids;
}

void GuestRuntime::start(const GuestRequest& request) {
  const auto& input = *static_cast<const StartInput*>(request.input);
  InstanceHandle& handle = this->handle(request.instance);
  handle.first_robot = input.first_robot;
  handle.robot_count = input.robot_count;
  shown_.clear();
  if (handle.info->kind == DMRP_KIND_PEDESTRIAN_MODEL) handle.grids = walking_grids(input.scene);
  handle.instance->start(*input.world, input.seed, request.budget_ns);
}

GuestRuntime::Shown& GuestRuntime::shown(std::uint32_t robot) {
  if (robot >= shown_.size()) shown_.resize(robot + std::size_t{1});
  return shown_[robot];
}

const void* GuestRuntime::reading(std::uint32_t instance, GuestQuestion::Kind kind, std::uint32_t robot) {
  const InstanceHandle& own = handle(instance);
  if (kind == GuestQuestion::subscribe_to_costmap) return ask_({kind, instance, robot});
  if (robot < own.first_robot || robot - own.first_robot >= own.robot_count) return nullptr;
  Shown& shown = this->shown(robot);
  shown.read |= 1u << kind;
  const void*& known = shown.readings.of[kind];
  if (!known) known = ask_({kind, instance, robot});
  return known;
}

void GuestRuntime::set_path(InstanceHandle& handle, const GuestRequest& request, const dmrp_path_update* update) {
  if (!update) return;
  const auto table = handle.instance->table<dmrp_local_controller>();
  handle.instance->call("set_path", request.step, request.budget_ns, Answers::no_other,
                        [&] { return table.set_path(handle.instance->self(), update); });
}

void GuestRuntime::control_all(const GuestRequest& request) {
  const auto& input = *static_cast<const ControlInput*>(request.input);
  if (handle(request.instance).info->has_flag(DMRP_FLAG_CENTRAL))
    control_fleet(request, input);
  else
    control_each(request, input);
}

void GuestRuntime::control_each(const GuestRequest& request, const ControlInput& input) {
  for (std::uint32_t i = 0; i < input.count; ++i) {
    const dmrp_observation& observation = input.observations[i];
    InstanceHandle& handle = this->handle(input.items[i].instance);
    shown_.clear();
    shown(observation.robot).readings = input.items[i].readings;
    set_path(handle, request, input.items[i].update);
    const auto table = handle.instance->table<dmrp_local_controller>();
    command_.clear();
    const auto result = handle.instance->call("step", request.step, request.budget_ns, Answers::no_solution, [&] {
      return table.step(handle.instance->self(), &observation, &command_.value);
    });
    command_.check(handle.instance->site("step", request.step), "dmrp_command");
    input.answers[i] = {{result.status, result.duration_ns}, command_.value, shown(observation.robot).read};
  }
}

void GuestRuntime::control_fleet(const GuestRequest& request, const ControlInput& input) {
  InstanceHandle& handle = this->handle(request.instance);
  shown_.clear();
  for (std::uint32_t i = 0; i < input.count; ++i) shown(input.observations[i].robot).readings = input.items[i].readings;
  for (std::uint32_t i = 0; i < input.count; ++i) set_path(handle, request, input.items[i].update);
  commands_.resize(input.count);
  for (std::uint32_t i = 0; i < input.count; ++i) commands_[i].struct_size = sizeof(dmrp_command);
  const dmrp_fleet fleet = {sizeof(fleet),        input.count,     input.observations, sizeof(dmrp_observation),
                            sizeof(dmrp_command), commands_.data()};
  const auto table = handle.instance->table<dmrp_local_controller>();
  const auto result = handle.instance->call("step_all", request.step, request.budget_ns, Answers::no_other,
                                            [&] { return table.step_all(handle.instance->self(), &fleet); });
  commands_.check(handle.instance->site("step_all", request.step), "the commands");
  for (std::uint32_t i = 0; i < input.count; ++i)
    input.answers[i] = {
        {commands_[i].status, result.duration_ns}, commands_[i], shown(input.observations[i].robot).read};
  *static_cast<CallAnswer*>(request.output) = {result.status, result.duration_ns};
}

void GuestRuntime::move_people(const GuestRequest& request) {
  const auto& input = *static_cast<const PeopleInput*>(request.input);
  InstanceHandle& handle = this->handle(request.instance);
  motions_.resize(input.crowd.person_count);
  dmrp_motions motions = {sizeof(motions), input.crowd.person_count, sizeof(dmrp_motion), 0, motions_.data()};
  const auto table = handle.instance->table<dmrp_pedestrian_model>();
  const auto result = handle.instance->call("step", request.step, request.budget_ns, Answers::no_other, [&] {
    return table.step(handle.instance->self(), &input.crowd, &motions);
  });
  motions_.check(handle.instance->site("step", request.step), "the motions");
  std::copy_n(motions_.data(), input.crowd.person_count, input.motions);
  *static_cast<CallAnswer*>(request.output) = {result.status, result.duration_ns};
}

std::string GuestRuntime::plan(const GuestRequest& request) {
  const auto& input = *static_cast<const PlanInput*>(request.input);
  InstanceHandle& handle = this->handle(request.instance);
  const PlannerAnswer answer = call_planner(*handle.instance, *input.problem, request.step);
  return plan_text(answer, input, handle.instance->site("plan", request.step));
}

std::string GuestRuntime::measure(const GuestRequest& request) {
  const auto& input = *static_cast<const MeasureInput*>(request.input);
  InstanceHandle& handle = this->handle(request.instance);
  if (!trace_)
    trace_ = std::make_unique<core::TraceReader>(
        input.trace ? core::TraceRecords(std::span(input.trace, input.trace_bytes)) : spool_(),
        core::TraceExtent::samples);
  const MetricResult result = host::measure(*trace_, walking_grids(input.scene), *handle.instance, *handle.info,
                                            input.index, input.seed, request.budget_ns);
  guard_.check_no_children();
  return nlohmann::json(result).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string GuestRuntime::timing() const {
  return nlohmann::json(guard_.timing()).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace dmrp::host
