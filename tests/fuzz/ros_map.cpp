// SPDX-License-Identifier: MIT
// Maps of map_server: the YAML file and its image, PGM or PNG.
#include "host/maps/ros_map.hpp"

#include "host/errors/input_error.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dmrp;
  static const test::ExperimentFolder folder;
  const auto [yaml, image] = fuzz::two_files(fuzz::text(data, size));
  fuzz::write_file("map.yaml", yaml);
  fuzz::write_file("image", image);
  try {
    host::read_ros_map(folder.path() / "map.yaml", "map.yaml", host::UnknownCells::occupied);
  } catch (const host::InputError&) {
  }
  return 0;
}
