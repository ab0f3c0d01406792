// SPDX-License-Identifier: MIT
// libdmrp_test_faults.so: one plugin of each kind that breaks its contract as its parameters say.
#include "tests/end_to_end/faulty_plugins/faulty_controller.hpp"
#include "tests/end_to_end/faulty_plugins/faulty_metric.hpp"
#include "tests/end_to_end/faulty_plugins/faulty_pedestrians.hpp"
#include "tests/end_to_end/faulty_plugins/faulty_planner.hpp"

using namespace dmrp::test;

DMRP_PLUGINS(FaultyController, FaultyPlanner, FaultyPedestrians, FaultyMetric<MetricFault::none>,
             FaultyMetric<MetricFault::crash>, FaultyMetric<MetricFault::exit>, FaultyMetric<MetricFault::memory>,
             FaultyMetric<MetricFault::rounding>, FaultyMetric<MetricFault::silent>,
             FaultyMetric<MetricFault::infinite>, FaultyMetric<MetricFault::beyond>,
             FaultyMetric<MetricFault::undeclared>, FaultyMetric<MetricFault::throw_in_begin>,
             FaultyMetric<MetricFault::flood>, FaultyMetric<MetricFault::recovers>)
