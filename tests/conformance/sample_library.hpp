// SPDX-License-Identifier: MIT
// sample_library.hpp: a plugin library inside the test program, and the arguments of its last calls.
#pragma once

#include <dmrp/dmrp.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

// As exported by a library. Holds sample.controller, sample.central, sample.planner, sample.pedestrian, sample.metric,
// sample.unmakeable and sample.windowed; their parameter `does` determines their calls: see sample_library.cpp.
extern "C" const dmrp_entry dmrp_entry_v1;

// An extension of the tests' own, which the C++ layer does not know.
#define SAMPLE_EXTENSION "org.example.number/1"
struct sample_extension {
  std::uint32_t struct_size;
  std::int32_t number;
};

namespace dmrp::test {

// The arguments that the plugins received, and what the static load() and unload() of their classes did.
struct Seen {
  std::vector<double> numbers;
  std::vector<std::string> texts;
  int alive = 0;  // instances of sample.controller
  std::vector<std::string> loaded, unloaded;
  std::string load_does, unload_does;  // as the parameter `does`
};
Seen& seen();

// A dmrp_host that stores log lines and errors. It offers the extensions that `offers` has.
class RecordingHost {
 public:
  RecordingHost();
  RecordingHost(const RecordingHost&) = delete;
  RecordingHost& operator=(const RecordingHost&) = delete;

  dmrp_host c{};
  std::vector<std::string> log;  // "LEVEL text"
  std::string error;             // the last text of set_error, "" if there was none
  std::int32_t stop = 0;
  std::int64_t budget_left_ns = 0;
  std::map<std::string, const void*> offers;
};

// Values as a newer host passes them: each in `stride` bytes, more than the plugin knows.
class ParamList {
 public:
  explicit ParamList(std::vector<dmrp_param_value> values);
  ParamList(const ParamList&) = delete;
  ParamList& operator=(const ParamList&) = delete;
  const dmrp_params* c() const { return &c_; }

 private:
  struct Longer {
    dmrp_param_value known;
    std::uint64_t unknown;
  };
  std::vector<Longer> values_;
  dmrp_params c_{};
};

dmrp_param_value text_value(const char* key, const char* text);

// An instance that is destroyed with this object. create() must succeed.
class Sample {
 public:
  Sample(const char* id, const char* does);
  ~Sample() { c.destroy(c.self); }
  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;

  template <class Interface>
  const Interface& as() const {
    return *static_cast<const Interface*>(c.table);
  }
  std::int32_t start(std::uint64_t seed = 1, std::int32_t robot = 0) const;

  RecordingHost host;
  dmrp_plugin c{};
};

}  // namespace dmrp::test
