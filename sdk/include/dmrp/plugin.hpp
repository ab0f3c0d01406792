// SPDX-License-Identifier: MIT
// plugin.hpp: the contract for C++17: a base class for each kind of plugin, parameters bound to members, spans for
// arrays, and trampolines that turn every exception into a status. Headers alone, nothing to link.
//
//   class Mine final : public dmrp::LocalController {
//    public:
//     static dmrp::Descriptor describe() { return dmrp::Descriptor("org.example.mine", "Mine", "0.1.0"); }
//     dmrp::Param<double> gain = param("gain", 2.0).unit("1/s").range(0.0, 10.0).doc("...");
//     void set_path(dmrp::Path path, std::uint64_t revision) override;
//     dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override;
//   };
//   DMRP_PLUGINS(Mine)
//
// A plugin class has a cheap default constructor: the library makes one object to read the parameter table.
#pragma once

#include <cstdint>

#include "cpp/global_planner.hpp"
#include "cpp/library.hpp"
#include "cpp/local_controller.hpp"
#include "cpp/metric.hpp"
#include "cpp/pedestrian_model.hpp"
#include "dmrp.h"
