// SPDX-License-Identifier: MIT
// bench_fleet: what a control tick of 100 robots costs the host, with a controller for each and with one for all. The
// law is the same (fleet/followers.cpp), and cheap: the rest is the host's part, from observations to checked commands.
// Sensing is not measured.
//
//   fleet/each/tick   processor time of a control tick of 100 robots, their calls of step(), in ms
//   fleet/all/tick    the same with one call of step_all()
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/trace/trace_encoder.hpp"
#include "core/world/world.hpp"
#include "host/experiment/experiment.hpp"
#include "host/plugins/calls/call_guard.hpp"
#include "host/trial/dispatcher.hpp"
#include "host/trial/trial_plugins.hpp"
#include "tests/bench/bench_rows.hpp"

namespace {

using namespace dmrp;

constexpr std::int64_t driven_ns = 20'000'000'000;
constexpr std::int64_t driven_quickly_ns = 1'000'000'000;

class Drive {
 public:
  Drive(const host::Experiment& experiment, const host::Combination& combination, const host::VariantWorld& variant,
        std::uint64_t seed, host::Guests& guests)
      : world_(variant.scenario, variant.types, variant.simulation, variant.geometry, variant.routes, seed),
        trace_(variant.view.world(), [](std::int64_t, std::span<const std::uint8_t>) {}),
        plugins_(guests, experiment, combination, variant, world_, seed, trace_),
        dispatcher_(variant, world_),
        period_ns_(variant.simulation.control_period_ns) {
    plan_ = plugins_.plan(nullptr, 0);
    if (!plan_.exists()) throw std::runtime_error("there is no plan");
    dispatcher_.set_plan(plan_);
  }

  // The mean time of a control tick (ms).
  double mean_tick_ms(std::int64_t until_ns) {
    double sum_s = 0.0;
    int ticks = 0;
    for (std::int64_t step = 0; world_.t_ns() < until_ns; ++step) {
      if (world_.t_ns() % period_ns_ == 0) {
        sum_s += tick(step);
        ++ticks;
      }
      world_.step({});
      dispatcher_.update_progress();
    }
    return 1e3 * sum_s / ticks;
  }

 private:
  // Returns its processor time.
  double tick(std::int64_t step) {
    dispatcher_.update_targets();
    plugins_.sense();
    driven_.clear();
    for (std::uint32_t i = 0; i < world_.robots().size(); ++i) {
      if (world_.robots()[i].state != DMRP_ROBOT_ACTIVE) continue;
      driven_.push_back({i, dispatcher_.guidance(i), dispatcher_.take_new_path(i)});
    }
    if (driven_.empty()) return 0.0;
    const double from_s = bench::processor_s();
    const auto answers = plugins_.control(driven_, step);
    const double duration_s = bench::processor_s() - from_s;
    for (std::size_t i = 0; i < driven_.size(); ++i)
      world_.set_command(driven_[i].robot, answers[i].command.value_or(dmrp_twist{}));
    return duration_s;
  }

  core::World world_;
  core::TraceEncoder trace_;
  host::TrialPlugins plugins_;
  host::Dispatcher dispatcher_;
  std::int64_t period_ns_;
  host::Plan plan_;
  std::vector<host::TrialPlugins::DrivenRobot> driven_;
};

host::Probe descriptors_of(const std::filesystem::path& file, const host::VisiblePaths&) {
  const host::Library library(file);
  return {library.plugins(), library.warnings(), library.objects(), ""};
}

std::vector<bench::Row> measure(bool quick) {
  const host::Experiment experiment = host::load_experiment(DMRP_BENCH_FOLDER "/fleet/fleet.toml", 0, &descriptors_of);
  const std::uint64_t seed = host::trial_seed(experiment, 0);
  const host::VariantWorld shared(experiment, experiment.scenarios[0]);
  const host::VariantWorld variant(experiment, experiment.scenarios[0], shared, seed);
  std::vector<bench::Row> rows;
  for (const host::Combination& combination : host::combinations(experiment)) {
    double best_ms = 1e9;
    for (int round = 0; round < (quick ? 1 : 3); ++round) {
      host::CallNote note{};
      host::CallGuard guard(note);
      host::Guests guests = host::Guests::local(experiment.libraries, note, guard,
                                                [](std::int32_t, const std::string&, const std::string&) {});
      Drive drive(experiment, combination, variant, seed, guests);
      best_ms = std::min(best_ms, drive.mean_tick_ms(quick ? driven_quickly_ns : driven_ns));
    }
    const auto controller = static_cast<std::size_t>(combination.local_controller);
    rows.push_back({"fleet/" + experiment.local_controllers[controller].label + "/tick", best_ms, "ms"});
  }
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Output output = bench::output_options(argc, argv);
  setenv("DMRP_PLUGIN_PATH", DMRP_FOLLOWERS_FOLDER, 0);
  try {
    bench::write_rows(measure(output.quick), output);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_fleet: %s\n", error.what());
    return 1;
  }
  return 0;
}
