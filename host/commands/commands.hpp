// SPDX-License-Identifier: MIT
// commands.hpp: the commands of `dmrp-host`, in the order of its help. Each has a file, whose function add_COMMAND()
// registers it with its options.
#pragma once

namespace CLI {
class App;
}

#define DMRP_COMMANDS(COMMAND) \
  COMMAND(run)                 \
  COMMAND(validate)            \
  COMMAND(plugins)             \
  COMMAND(check)               \
  COMMAND(draw)                \
  COMMAND(video)               \
  COMMAND(evaluate)            \
  COMMAND(merge)               \
  COMMAND(bundle)              \
  COMMAND(verify)              \
  COMMAND(compare)             \
  COMMAND(export)              \
  COMMAND(plan)                \
  COMMAND(keys)                \
  COMMAND(new)                 \
  COMMAND(report)

namespace dmrp::host {

#define DMRP_DECLARE(name) void add_##name(CLI::App& app);
DMRP_COMMANDS(DMRP_DECLARE)
#undef DMRP_DECLARE

}  // namespace dmrp::host
