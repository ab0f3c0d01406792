// SPDX-License-Identifier: MIT
// cpp/parameters.hpp: parameters bound to members of a plugin class.
//
//   dmrp::Param<double> gain = param("gain", 2.0).unit("1/s").range(0.0, 10.0).doc("turn rate per radian of error");
//   dmrp::Param<int> samples = param("samples", 20).range(1, 1000).doc("trajectories a tick");
//
// The declarations of a class form its parameter table; the values are set before start() is called.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
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
inline void assign(int& to, const dmrp_param_value& from) {
  if (from.integer < std::numeric_limits<int>::min() || from.integer > std::numeric_limits<int>::max())
    throw std::out_of_range(std::string(from.key) + " does not fit into an int");
  to = static_cast<int>(from.integer);
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

// Whether a default of type From declares a parameter of type To: the same type, an integer for any integer type, an
// integer for a double.
template <class To, class From>
constexpr bool declares = std::is_same_v<To, From> || (std::is_same_v<From, std::int64_t> &&
                                                       (std::is_same_v<To, int> || std::is_same_v<To, double>));

template <class To, class From>
To convert(const From& value) {
  static_assert(declares<To, From>, "dmrp::Param<T>: the default given to param() is of another type than T");
  if constexpr (declares<To, From>) {
    return static_cast<To>(value);
  } else {
    return To();
  }
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
    static_assert(std::is_same_v<T, std::string>, "choices() is for a parameter that is a text");
    definition_->type = DMRP_PARAM_CHOICE;
    definition_->choices = std::move(choices);
    return *this;
  }
  // For a text: it is the path of a file; the host resolves it against the folder of the experiment file.
  ParamBuilder& path() {
    static_assert(std::is_same_v<T, std::string>, "path() is for a parameter that is a text");
    return definition_->type = DMRP_PARAM_PATH, *this;
  }

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
  static_assert(std::is_same_v<T, bool> || std::is_same_v<T, int> || std::is_same_v<T, std::int64_t> ||
                    std::is_same_v<T, double> || std::is_same_v<T, std::string> ||
                    std::is_same_v<T, std::vector<double>> || std::is_same_v<T, std::vector<std::string>>,
                "dmrp::Param<T>: T is bool, int, std::int64_t, double, std::string, std::vector<double> or "
                "std::vector<std::string>");

  template <class From>
  Param(const ParamBuilder<From>& declared)  // implicit: `Param<double> x = param(...)`
      : value_(detail::convert<T>(declared.value_)) {
    if constexpr (!std::is_same_v<T, From> && std::is_same_v<T, double>) {
      declared.definition_->integer = 0;
      detail::fall_back(*declared.definition_, value_);
    }
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

// A parameter that is a text compares with texts. (Numbers compare through their conversion; the operators of
// std::string are templates, which take no conversions.)
inline bool operator==(const Param<std::string>& a, std::string_view b) {
  return *a == b;
}
inline bool operator==(std::string_view a, const Param<std::string>& b) {
  return a == *b;
}
inline bool operator==(const Param<std::string>& a, const Param<std::string>& b) {
  return *a == *b;
}
inline bool operator!=(const Param<std::string>& a, std::string_view b) {
  return *a != b;
}
inline bool operator!=(std::string_view a, const Param<std::string>& b) {
  return a != *b;
}
inline bool operator!=(const Param<std::string>& a, const Param<std::string>& b) {
  return *a != *b;
}

}  // namespace dmrp
