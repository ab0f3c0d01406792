// SPDX-License-Identifier: MIT
#include "controllers/mppi/noise.hpp"

#include <dmrp/toolkit/random.hpp>
#include <vector>

namespace dmrp::controllers::mppi {

namespace {

constexpr std::uint32_t table_size = 1u << 16;  // a power of two: places wrap

// The first numbers stand again at the end, so that a block never wraps.
std::vector<float> make_table() {
  std::vector<float> table(table_size + lanes);
  toolkit::Stream normals(0, "mppi.noise");
  for (std::uint32_t i = 0; i < table_size; ++i) table[i] = static_cast<float>(normals.normal());
  for (std::uint32_t i = 0; i < lanes; ++i) table[table_size + i] = table[i];
  return table;
}

}  // namespace

void Noise::start(std::uint64_t seed, std::int32_t robot) {
  static const std::vector<float> table = make_table();
  table_ = table.data();
  toolkit::KeyChain chain(seed);
  chain.add(static_cast<std::uint64_t>(robot));
  key_ = {static_cast<std::uint32_t>(chain.value()), static_cast<std::uint32_t>(chain.value() >> 32)};
}

std::uint32_t Noise::row(std::uint32_t cycle, std::uint32_t step, std::uint32_t axis) const {
  return toolkit::philox4x32_10({cycle, step, axis, 0}, key_)[0] % table_size;
}

Eigen::Map<const Lanes> Noise::block(std::uint32_t row, int block) const {
  return Eigen::Map<const Lanes>(table_ + (row + static_cast<std::uint32_t>(block * lanes)) % table_size);
}

}  // namespace dmrp::controllers::mppi
