// SPDX-License-Identifier: MIT
// cpp/descriptor.hpp: the description of a plugin class, built in its static describe().
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../descriptor.h"
#include "parameters.hpp"

namespace dmrp {

enum class Direction : std::uint32_t {
  none = DMRP_DIRECTION_NONE,
  lower_is_better = DMRP_DIRECTION_LOWER,
  higher_is_better = DMRP_DIRECTION_HIGHER
};

// The subjects of a metric's value; the system always has a value.
enum class Subjects : std::uint32_t {
  system = 1u << DMRP_SUBJECT_SYSTEM,
  system_and_robots = 1u << DMRP_SUBJECT_SYSTEM | 1u << DMRP_SUBJECT_ROBOT,
  system_and_pedestrians = 1u << DMRP_SUBJECT_SYSTEM | 1u << DMRP_SUBJECT_PEDESTRIAN
};

// What a metric's value can be, both ends included.
struct ValueRange {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
};
inline constexpr ValueRange share_range{0.0, 1.0};
inline constexpr ValueRange percent_range{0.0, 100.0};
inline constexpr ValueRange never_negative{0.0, std::numeric_limits<double>::infinity()};

class Descriptor {
 public:
  Descriptor(std::string id, std::string name, std::string version)
      : id_(std::move(id)), name_(std::move(name)), version_(std::move(version)) {}

  Descriptor& vendor(std::string text) { return vendor_ = std::move(text), *this; }
  Descriptor& license(std::string spdx) { return license_ = std::move(spdx), *this; }
  Descriptor& url(std::string home) { return url_ = std::move(home), *this; }
  Descriptor& manual_url(std::string manual) { return manual_url_ = std::move(manual), *this; }
  Descriptor& features(std::vector<std::string> words) { return features_ = std::move(words), *this; }
  Descriptor& summary(std::string line) { return summary_ = std::move(line), *this; }
  Descriptor& source(std::string paper) { return source_ = std::move(paper), *this; }

  // Extensions of the host, by id (DMRP_EXT_*): the plugin cannot run without those that it needs, and uses the others
  // when they are available.
  Descriptor& needs(std::string id) { return needed_.push_back(std::move(id)), *this; }
  Descriptor& uses(std::string id) { return uses_.push_back(std::move(id)), *this; }

  // Planners.
  Descriptor& connectivity(std::uint32_t connectivity) { return connectivity_ = connectivity, *this; }
  Descriptor& uncoordinated() { return flags(DMRP_FLAG_UNCOORDINATED); }

  // Controllers: the drives that they can drive, as bits 1u << DMRP_KINEMATICS_*; differential alone if not given.
  Descriptor& kinematics(std::uint32_t bits) { return kinematics_ = bits, *this; }

  // Adds DMRP_FLAG_* bits. (CentralController sets DMRP_FLAG_CENTRAL itself.)
  Descriptor& flags(std::uint32_t bits) { return flags_ |= bits, *this; }

  // Metrics: the values computed, and the channels (DMRP_CHANNEL_* bits) needed for them.
  Descriptor& value(std::string name, std::string unit, Direction direction, Subjects subjects, std::string description,
                    ValueRange range = {}) {
    values_.push_back({std::move(name), std::move(unit), std::move(description), direction, subjects, 0, 0, range});
    return *this;
  }
  Descriptor& wall_clock() { return values_.back().wall_clock = 1, *this; }  // marks the value added last
  Descriptor& curve() { return values_.back().curve = 1, *this; }            // marks the value added last
  Descriptor& channels(std::uint32_t bits) { return channels_ = bits, *this; }

 private:
  friend class PublishedDescriptor;
  struct Value {
    std::string name, unit, description;
    Direction direction;
    Subjects subjects;
    std::uint32_t wall_clock, curve;
    ValueRange range;
  };
  std::string id_, name_, version_, vendor_, license_, url_, manual_url_, summary_, source_;
  std::vector<std::string> features_, needed_, uses_;
  std::vector<Value> values_;
  std::uint32_t connectivity_ = DMRP_CONNECTIVITY_NONE;
  std::uint32_t flags_ = 0;
  std::uint32_t kinematics_ = 0;
  std::uint32_t channels_ = 0;
};

// A descriptor and a parameter table as the C structs that the host reads. Owns all the data; cannot be moved.
class PublishedDescriptor {
 public:
  PublishedDescriptor(Descriptor descriptor, std::uint32_t kind,
                      std::vector<std::unique_ptr<ParamDefinition>> parameters)
      : descriptor_(std::move(descriptor)), parameters_(std::move(parameters)) {
    publish_parameters();
    publish_values();
    features_ = pointers(descriptor_.features_);
    features_.push_back(nullptr);
    needed_ = pointers(descriptor_.needed_);
    uses_ = pointers(descriptor_.uses_);

    c_.struct_size = sizeof(c_);
    c_.kind = kind;
    c_.id = descriptor_.id_.c_str();
    c_.name = descriptor_.name_.c_str();
    c_.version = descriptor_.version_.c_str();
    c_.vendor = descriptor_.vendor_.c_str();
    c_.license = descriptor_.license_.c_str();
    c_.url = descriptor_.url_.c_str();
    c_.manual_url = descriptor_.manual_url_.c_str();
    c_.summary = descriptor_.summary_.c_str();
    c_.source = descriptor_.source_.c_str();
    c_.features = features_.data();
    c_.needed = needed_.data();
    c_.needed_count = static_cast<std::uint32_t>(needed_.size());
    c_.uses = uses_.data();
    c_.uses_count = static_cast<std::uint32_t>(uses_.size());
    c_.params = specs_.data();
    c_.param_count = static_cast<std::uint32_t>(specs_.size());
    c_.param_stride = sizeof(dmrp_param_spec);
    c_.flags = descriptor_.flags_;
    c_.traits = traits();
  }
  PublishedDescriptor(const PublishedDescriptor&) = delete;
  PublishedDescriptor& operator=(const PublishedDescriptor&) = delete;

  const dmrp_descriptor& get() const { return c_; }

 private:
  static std::vector<const char*> pointers(const std::vector<std::string>& texts) {
    std::vector<const char*> out;
    for (const std::string& text : texts) out.push_back(text.c_str());
    return out;
  }

  void publish_parameters() {
    for (const auto& d : parameters_) {
      choices_.push_back(pointers(d->choices));
      texts_.push_back(pointers(d->texts));
      dmrp_param_spec spec{};
      spec.key = d->key.c_str();
      spec.type = d->type;
      spec.count = static_cast<std::uint32_t>(d->numbers.size() + d->texts.size());
      spec.integer = d->integer;
      spec.number = d->number;
      spec.text = d->text.c_str();
      spec.numbers = d->numbers.data();
      spec.texts = texts_.back().data();
      spec.unit = d->unit.c_str();
      spec.doc = d->doc.c_str();
      spec.minimum = d->minimum;
      spec.maximum = d->maximum;
      spec.choices = choices_.back().data();
      spec.choice_count = static_cast<std::uint32_t>(d->choices.size());
      specs_.push_back(spec);
    }
  }

  // Those of the plugin's kind.
  const void* traits() {
    switch (c_.kind) {
      case DMRP_KIND_GLOBAL_PLANNER:
        planner_ = {sizeof(planner_), descriptor_.connectivity_};
        return &planner_;
      case DMRP_KIND_LOCAL_CONTROLLER:
        controller_ = {sizeof(controller_), descriptor_.kinematics_};
        return &controller_;
      case DMRP_KIND_METRIC:
        metric_ = {sizeof(metric_), descriptor_.channels_, values_.data(), static_cast<std::uint32_t>(values_.size()),
                   sizeof(dmrp_metric_value_spec)};
        return &metric_;
      default:
        return nullptr;
    }
  }

  void publish_values() {
    for (const Descriptor::Value& v : descriptor_.values_) {
      values_.push_back({v.name.c_str(), v.unit.c_str(), v.description.c_str(), static_cast<std::uint32_t>(v.direction),
                         static_cast<std::uint32_t>(v.subjects), v.wall_clock, v.curve, v.range.minimum,
                         v.range.maximum});
    }
  }

  Descriptor descriptor_;
  std::vector<std::unique_ptr<ParamDefinition>> parameters_;
  std::vector<std::vector<const char*>> choices_, texts_;
  std::vector<dmrp_param_spec> specs_;
  std::vector<dmrp_metric_value_spec> values_;
  std::vector<const char*> features_, needed_, uses_;
  dmrp_planner_traits planner_{};
  dmrp_controller_traits controller_{};
  dmrp_metric_traits metric_{};
  dmrp_descriptor c_{};
};

}  // namespace dmrp
