// SPDX-License-Identifier: MIT
// parameters.hpp: the parameters of the timed elastic band, as the plugin declares them and as the planner reads them.
// Both come from the table in parameters.inc.
#pragma once

#include <cstddef>

namespace dmrp::controllers::teb {

struct Parameters {
#define NUMBER(name, value, unit, minimum, maximum, doc) double name = value;
#define COUNT(name, value, minimum, maximum, doc) std::size_t name = value;
#define FLAG(name, value, doc) bool name = value;
#define WEIGHT(name, value, doc) double name = value;
#include "controllers/teb/parameters.inc"
};

}  // namespace dmrp::controllers::teb
