// SPDX-License-Identifier: MIT
// grown_extensions.hpp: the host's extensions, and what they return, as long as a later minor version would make them.
#pragma once

#include <dmrp/ext/obstacle_clusters.h>

#include <cstdint>
#include <deque>
#include <string_view>

#include "host/check/rehearsal/inputs.hpp"

namespace dmrp::host {

class GrownExtensions {
 public:
  // `grown_bytes`, a multiple of 8: by which they are longer.
  explicit GrownExtensions(std::uint32_t grown_bytes) : tables_(grown_bytes), results_(grown_bytes) {}
  GrownExtensions(const GrownExtensions&) = delete;
  GrownExtensions& operator=(const GrownExtensions&) = delete;

  // A longer copy of this extension of the host, which outlives this object. nullptr stays so.
  const void* grown(std::string_view id, const void* extension);

 private:
  // Where the functions of a copy find the host's table.
  struct Origin {
    const void* table;
    GrownExtensions* self;
  };

  // A copy of the table that has this function, which then gives longer copies of what the host's gives.
  template <auto function, class Table, class Result, class Argument>
  const void* wrapped(const Result* (*Table::*)(const Table*, Argument), const void* extension);

  template <class Result>
  const Result* longer(const Result& result) {
    return results_.one(result);
  }
  const dmrp_obstacle_cluster_list* longer(const dmrp_obstacle_cluster_list& list);

  Inputs tables_;
  Inputs results_;
  std::deque<Origin> origins_;
};

}  // namespace dmrp::host
