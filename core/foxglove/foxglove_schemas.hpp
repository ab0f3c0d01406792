// SPDX-License-Identifier: MIT
// foxglove_schemas.hpp: the message schemas of Foxglove that traces use (https://docs.foxglove.dev/docs/sdk/schemas),
// as JSON Schema with Foxglove's names, fields and types, without the descriptions.
#pragma once

#include "core/mcap/mcap.hpp"

namespace dmrp::core {

McapSchema scene_update_schema();
McapSchema frame_transforms_schema();
McapSchema laser_scan_schema();
McapSchema log_schema();

}  // namespace dmrp::core
