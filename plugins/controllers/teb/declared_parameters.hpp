// SPDX-License-Identifier: MIT
// declared_parameters.hpp: declares the parameters of the timed elastic band to the host.
#pragma once

#include "controllers/motion/path_controller.hpp"
#include "controllers/teb/parameters.hpp"

namespace dmrp::controllers::teb {

class DeclaredParameters : public PathController {
 protected:
  // The values that the host has set; complete from start() on.
  Parameters parameters() const {
    Parameters values;
#define NUMBER(name, value, unit, minimum, maximum, doc) values.name = name;
#define COUNT(name, value, minimum, maximum, doc) values.name = static_cast<std::size_t>(*name);
#define FLAG(name, value, doc) values.name = name;
#define WEIGHT(name, value, doc) values.name = name;
#include "controllers/teb/parameters.inc"
    return values;
  }

 private:
#define NUMBER(name, value, unit_of, minimum, maximum, doc_of) \
  Param<double> name = param(#name, value).unit(unit_of).range(minimum, maximum).doc(doc_of);
#define COUNT(name, value, minimum, maximum, doc_of) \
  Param<std::int64_t> name = param(#name, value).unit("1").range(minimum, maximum).doc(doc_of);
#define FLAG(name, value, doc_of) Param<bool> name = param(#name, value).doc(doc_of);
#define WEIGHT(name, value, doc_of) \
  Param<double> name = param(#name, value).unit("1").range(0.0, 1e5).doc("weight " doc_of);
#include "controllers/teb/parameters.inc"
};

}  // namespace dmrp::controllers::teb
