// SPDX-License-Identifier: MIT
// Maps and tasks of the MovingAI benchmarks: .map and .scen.
#include "host/maps/movingai.hpp"

#include "host/errors/input_error.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dmrp;
  static const test::ExperimentFolder folder;
  const auto [map_text, tasks_text] = fuzz::two_files(fuzz::text(data, size));
  fuzz::write_file("m.map", map_text);
  fuzz::write_file("s.scen", tasks_text);
  try {
    const core::CellMap map = host::read_movingai_map("m.map", "m.map");
    host::read_movingai_tasks("s.scen", "s.scen", map);
  } catch (const host::InputError&) {
  }
  return 0;
}
