// SPDX-License-Identifier: MIT
// cpp/parameters.hpp: parameters bound to members of a plugin class.
//
//   dmrp::Param<double> gain = param("gain", 2.0).unit("1/s").range(0.0, 10.0).doc("turn rate per radian of error");
//
// The declarations of a class form its parameter table; the values are set before start() is called.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../parameter.h"

namespace dmrp {

// The declaration of one parameter, and the member that takes its value.
struct ParamDefinition {
  std::string key;
  std::string unit;
  std::string doc;
  std::uint32_t type = 0;  // DMRP_PARAM_*
  std::int64_t integer = 0;
  double number = 0.0;
  std::string text;
  std::vector<double> numbers;
  std::vector<std::string> texts;
  std::vector<std::string> choices;
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  void* target = nullptr;  // the member; `assign` knows its type
  void (*assign)(void* target, const dmrp_param_value& value) = nullptr;
};

namespace detail {

inline void assign(bool& to, const dmrp_param_value& from) {
  to = from.integer != 0;
}
inline void assign(std::int64_t& to, const dmrp_param_value& from) {
  to = from.integer;
}
inline void assign(double& to, const dmrp_param_value& from) {
  to = from.number;
}
inline void assign(std::string& to, const dmrp_param_value& from) {
  to = from.text;
}
inline void assign(std::vector<double>& to, const dmrp_param_value& from) {
  to.assign(from.numbers, from.numbers + from.count);
}
inline void assign(std::vector<std::string>& to, const dmrp_param_value& from) {
  to.assign(from.texts, from.texts + from.count);
}

inline void fall_back(ParamDefinition& d, bool value) {
  d.type = DMRP_PARAM_BOOL, d.integer = value;
}
inline void fall_back(ParamDefinition& d, std::int64_t value) {
  d.type = DMRP_PARAM_INT, d.integer = value;
}
inline void fall_back(ParamDefinition& d, double value) {
  d.type = DMRP_PARAM_DOUBLE, d.number = value;
}
inline void fall_back(ParamDefinition& d, std::string value) {
  d.type = DMRP_PARAM_STRING, d.text = std::move(value);
}
inline void fall_back(ParamDefinition& d, std::vector<double> value) {
  d.type = DMRP_PARAM_DOUBLE_ARRAY, d.numbers = std::move(value);
}
inline void fall_back(ParamDefinition& d, std::vector<std::string> value) {
  d.type = DMRP_PARAM_STRING_ARRAY, d.texts = std::move(value);
}

}  // namespace detail

// Declares one parameter; made by Plugin::param(), converted to a Param.
template <class T>
class ParamBuilder {
 public:
  ParamBuilder(std::vector<std::unique_ptr<ParamDefinition>>& table, const char* key, T value) {
    table.push_back(std::make_unique<ParamDefinition>());
    definition_ = table.back().get();
    definition_->key = key;
    detail::fall_back(*definition_, value);
    value_ = std::move(value);
  }

  // (Moved from a temporary: gcc 12 gives a false -Wrestrict warning if a literal is assigned.)
  ParamBuilder& unit(const char* unit) { return definition_->unit = std::string(unit), *this; }
  ParamBuilder& doc(const char* doc) { return definition_->doc = std::string(doc), *this; }
  ParamBuilder& range(double minimum, double maximum) {
    definition_->minimum = minimum;
    definition_->maximum = maximum;
    return *this;
  }
  // For a text: the accepted values.
  ParamBuilder& choices(std::vector<std::string> choices) {
    definition_->type = DMRP_PARAM_CHOICE;
    definition_->choices = std::move(choices);
    return *this;
  }
  // For a text: it is the path of a file; the host resolves it against the folder of the experiment file.
  ParamBuilder& path() { return definition_->type = DMRP_PARAM_PATH, *this; }

 private:
  template <class>
  friend class Param;
  ParamDefinition* definition_;
  T value_;
};

// A parameter's value, readable as a T. A member of the plugin object, which never moves.
template <class T>
class Param {
 public:
  Param(const ParamBuilder<T>& declared) : value_(declared.value_) {  // implicit: `Param<double> x = param(...)`
    declared.definition_->target = &value_;
    declared.definition_->assign = [](void* target, const dmrp_param_value& value) {
      detail::assign(*static_cast<T*>(target), value);
    };
  }
  Param(const Param&) = delete;
  Param& operator=(const Param&) = delete;

  operator const T&() const { return value_; }
  const T& operator*() const { return value_; }
  const T* operator->() const { return &value_; }

 private:
  T value_;
};

}  // namespace dmrp
