// SPDX-License-Identifier: MIT
// cpp/plugin_base.hpp: the base class of every plugin class: parameters, the host, the world of the trial.
#pragma once

#include <cstdint>
#include <exception>
#include <initializer_list>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "../plugin.h"
#include "extensions.hpp"
#include "parameters.hpp"
#include "span.hpp"
#include "trial_end.hpp"

namespace dmrp {

using Vec2 = dmrp_vec2;
using Pose = dmrp_pose;
using Twist = dmrp_twist;
using Segment = dmrp_segment;
using Limits = dmrp_limits;
using Footprint = dmrp_footprint;
using Polygon = dmrp_polygon;
using Goal = dmrp_goal;
using Grid = dmrp_grid;
using Shape = dmrp_shape;

// dmrp_robot with its goals as a span.
struct Robot : dmrp_robot {
  Span<Goal> goals() const { return {dmrp_robot::goals, goal_count, goal_stride}; }
};

// As in status.h.
enum class Status : std::int32_t {
  ok = DMRP_OK,
  warning = DMRP_WARNING,
  no_solution = DMRP_NO_SOLUTION,
  timeout = DMRP_TIMEOUT,
  out_of_memory = DMRP_OUT_OF_MEMORY,
  error = DMRP_ERROR,
  fatal = DMRP_FATAL,
  unsupported = DMRP_UNSUPPORTED
};

// Thrown from a call that may return Status::unsupported: this trial is not for the plugin. A std::exception of another
// class is an error.
class Unsupported : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class LogLevel : std::int32_t {
  debug = DMRP_LOG_DEBUG,
  info = DMRP_LOG_INFO,
  warning = DMRP_LOG_WARNING,
  error = DMRP_LOG_ERROR
};

constexpr double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

// dmrp_world with spans for arrays. Valid from start() until the next start() or the destructor begins.
class World {
 public:
  World() = default;
  explicit World(const dmrp_world& c) : c_(&c) {}

  Span<Robot> robots() const { return {c_->robots, c_->robot_count, c_->robot_stride}; }
  Span<Shape> shapes() const { return {c_->shapes, c_->shape_count, c_->shape_stride}; }
  Span<Segment> segments() const { return {c_->segments, c_->segment_count}; }
  const Grid& planning_grid() const { return *c_->planning_grid; }
  const dmrp_world* operator->() const { return c_; }  // the scalars: world->lower, world->step_ns, ...

 private:
  const dmrp_world* c_ = nullptr;
};

inline Span<Polygon> parts(const Footprint& footprint) {
  return {footprint.parts, footprint.part_count, footprint.part_stride};
}

// dmrp_start with the world as a class.
struct Start {
  World world;
  std::uint64_t seed;
  std::int32_t robot;  // the robot that this local controller drives, or DMRP_NO_ROBOT
};

// The host of a library or an instance.
class Host {
 public:
  explicit Host(const dmrp_host* c) : c_(c) {}

  void log(LogLevel level, const std::string& text) const {
    c_->log(c_, static_cast<std::int32_t>(level), text.c_str());
  }
  void set_error(const std::string& text) const { c_->set_error(c_, text.c_str()); }
  bool should_stop() const { return c_->should_stop(c_) != 0; }
  std::int64_t budget_left_ns() const { return c_->budget_left_ns(c_); }
  std::string library_path() const { return c_->library_path; }  // weights and other data are installed beside it
  const dmrp_host* c() const { return c_; }

 private:
  const dmrp_host* c_;
};

// The host and the parameters' values are available from start() on, not in the constructor. The library makes one more
// object of each class to read its parameter table; that object is never started.
class Plugin {
 public:
  Plugin() = default;
  Plugin(const Plugin&) = delete;
  Plugin& operator=(const Plugin&) = delete;
  virtual ~Plugin() = default;

  // Begins a trial: reset all state of an earlier one. world() is set, extension() may be called. Status::unsupported
  // says that this trial is not for the plugin.
  virtual Status start(const Start&) { return Status::ok; }

  // The trial has ended, without a fault: the place to free what belongs to it. Not called for metrics.
  virtual void trial_end(const TrialEnd&) {}

  // An extension that the plugin provides to the host, or nullptr.
  virtual const void* offered_extension(const char* /*id*/) { return nullptr; }

  // Of a base class: what it adds to the descriptor's flags.
  DMRP_LOCAL static constexpr std::uint32_t interface_flags = 0;

 protected:
  ParamBuilder<bool> param(const char* key, bool value) { return {parameters_, key, value}; }
  template <class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
  ParamBuilder<std::int64_t> param(const char* key, Integer value) {
    return {parameters_, key, static_cast<std::int64_t>(value)};
  }
  ParamBuilder<double> param(const char* key, double value) { return {parameters_, key, value}; }
  ParamBuilder<std::string> param(const char* key, const char* value) { return {parameters_, key, value}; }
  ParamBuilder<std::vector<double>> param(const char* key, std::initializer_list<double> value) {
    return {parameters_, key, std::vector<double>(value)};
  }
  ParamBuilder<std::vector<std::string>> param(const char* key, std::initializer_list<const char*> value) {
    return {parameters_, key, std::vector<std::string>(value.begin(), value.end())};
  }
  ParamBuilder<std::vector<double>> param(const char* key, std::vector<double> value) {
    return {parameters_, key, std::move(value)};
  }
  ParamBuilder<std::vector<std::string>> param(const char* key, std::vector<std::string> value) {
    return {parameters_, key, std::move(value)};
  }

  const World& world() const { return world_; }
  Host host() const { return Host(host_); }
  void log(LogLevel level, const std::string& text) const { host().log(level, text); }
  void set_error(const std::string& text) const { host().set_error(text); }
  bool should_stop() const { return host().should_stop(); }

  // An extension of the host, as its C struct: extension<dmrp_lidar>(). Ask in start(). The first throws if there is
  // none; the second returns nullptr.
  template <class T>
  const T& extension() const {
    if (const T* found = find_extension<T>()) return *found;
    throw std::runtime_error(std::string("the host gives no ") + ExtensionId<T>::value +
                             ": declare it in describe() by needs() or uses()");
  }
  template <class T>
  const T* find_extension() const {
    return static_cast<const T*>(host_->get_extension(host_, ExtensionId<T>::value));
  }

 private:
  friend struct PluginAccess;
  std::vector<std::unique_ptr<ParamDefinition>> parameters_;
  const dmrp_host* host_ = nullptr;
  World world_;
};

// Gives the trampolines access to private members of Plugin.
struct PluginAccess {
  static std::vector<std::unique_ptr<ParamDefinition>>& parameters(Plugin& p) { return p.parameters_; }

  static void configure(Plugin& plugin, const dmrp_host* host, const dmrp_params& values) {
    plugin.host_ = host;
    for (std::uint32_t i = 0; i < values.count; ++i) {
      const dmrp_param_value& value = *DMRP_AT(dmrp_param_value, values.values, values.stride, i);
      for (const auto& definition : plugin.parameters_)
        if (definition->target && definition->key == value.key) definition->assign(definition->target, value);
    }
  }

  static Status start(Plugin& plugin, const dmrp_start& c) {
    plugin.world_ = World(*c.world);
    return plugin.start({plugin.world_, c.seed, c.robot});
  }

  // Runs `call`, which returns a Status, and turns every exception into a status.
  template <class Call>
  static std::int32_t guarded(const dmrp_host* host, Call&& call) noexcept {
    try {
      return static_cast<std::int32_t>(call());
    } catch (const std::bad_alloc&) {
      return DMRP_OUT_OF_MEMORY;
    } catch (const Unsupported& reason) {
      host->set_error(host, reason.what());
      return DMRP_UNSUPPORTED;
    } catch (const std::exception& error) {
      host->set_error(host, error.what());
    } catch (...) {
      host->set_error(host, "an exception that is no std::exception");
    }
    return DMRP_ERROR;
  }
  template <class Call>
  static std::int32_t guarded(const Plugin& plugin, Call&& call) noexcept {
    return guarded(plugin.host_, std::forward<Call>(call));
  }
};

namespace detail {

inline dmrp_instance* to_instance(Plugin* plugin) {
  return reinterpret_cast<dmrp_instance*>(plugin);
}

template <class Kind>
Kind& from_instance(dmrp_instance* self) {
  return static_cast<Kind&>(*reinterpret_cast<Plugin*>(self));
}

}  // namespace detail

}  // namespace dmrp
