// SPDX-License-Identifier: MIT
// guest_runtime.hpp: one library and its instances, and all calls into them: what a guest process runs, and a debugged trial
// runs in its own.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/trace/trace_reader.hpp"
#include "host/guests/exchange/guest_request.hpp"
#include "host/guests/inside/annotations.hpp"
#include "host/guests/inside/sensor_readings.hpp"
#include "host/plugins/calls/output.hpp"
#include "host/plugins/instance.hpp"
#include "host/world/walking_grids.hpp"

namespace dmrp::host {

class GuestRuntime {
 public:
  // Gives the answer of the judge; nullptr if it has none.
  using Ask = std::function<const void*(const GuestQuestion& question)>;
  // Gives the records of a trace that is too large to be shown in memory.
  using Spool = std::function<core::TraceRecords()>;

  // `written`: how the experiment names the library. `note`: that of the guard.
  GuestRuntime(std::string written, std::filesystem::path file, CallNote& note, CallGuard& guard, LogSink log, Ask ask,
               Spool spool = {});
  ~GuestRuntime();
  GuestRuntime(const GuestRuntime&) = delete;
  GuestRuntime& operator=(const GuestRuntime&) = delete;

  // Does what the request says. Returns the answer's text; "" where there is none. Throws PluginFault, and
  // std::runtime_error in one line if the library cannot be loaded. `text`: of a request that has one.
  std::string answer(const GuestRequest& request, const std::string& text);

  // Of the last request.
  AnnotationBuffer& annotations() { return annotations_; }

  // What begin_trial told last.
  const std::optional<BeginInput>& trial() const { return trial_; }

 private:
  struct InstanceHandle {
    const PluginInfo* info = nullptr;
    std::unique_ptr<Annotations> annotations;
    std::unique_ptr<SensorReadings> sensors;
    std::shared_ptr<WalkingGrids> grids;  // of the trial
    std::uint32_t first_robot = 0;        // those that a controller drives
    std::uint32_t robot_count = 0;
    std::unique_ptr<Instance> instance;  // destroyed first
  };

  // The readings of a robot in the call that runs: those that came with the observation, and answers to questions.
  struct Shown {
    SentReadings readings;
    std::uint32_t read;  // bits 1u << GuestQuestion::Kind
  };

  void load();
  std::string probe();
  void unload();
  void create(std::uint32_t number, const std::string& text);
  void start(const GuestRequest& request);
  void control_all(const GuestRequest& request);
  void control_each(const GuestRequest& request, const ControlInput& input);
  void control_fleet(const GuestRequest& request, const ControlInput& input);
  void set_path(InstanceHandle& handle, const GuestRequest& request, const dmrp_path_update* update);
  void move_people(const GuestRequest& request);
  Shown& shown(std::uint32_t robot);
  const void* reading(std::uint32_t instance, GuestQuestion::Kind kind, std::uint32_t robot);
  std::string plan(const GuestRequest& request);
  std::string measure(const GuestRequest& request);
  std::string timing() const;

  InstanceHandle& handle(std::uint32_t number) { return handles_.at(number); }
  void offer(std::uint32_t number, InstanceHandle& handle);
  std::shared_ptr<WalkingGrids> walking_grids(const SentScene& scene);

  const std::string written_;
  const std::filesystem::path file_;
  CallNote& note_;
  CallGuard& guard_;
  const LogSink log_;
  const Ask ask_;
  const Spool spool_;
  std::optional<BeginInput> trial_;
  AnnotationBuffer annotations_;
  std::unique_ptr<Library> library_;
  std::unique_ptr<PluginHost> library_host_;
  std::map<const dmrp_world*, std::shared_ptr<WalkingGrids>> walking_grids_;  // by scene
  std::shared_ptr<WalkingGrids> trace_grids_;                                 // of the world that the trace tells of
  std::unique_ptr<core::TraceReader> trace_;  // of this trial, decoded once for all its metrics
  std::vector<Shown> shown_;                  // by robot
  Output<dmrp_command> command_;
  OutputArray<dmrp_command> commands_;
  OutputArray<dmrp_motion> motions_;
  std::map<std::uint32_t, InstanceHandle> handles_;
};

}  // namespace dmrp::host
