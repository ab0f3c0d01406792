// SPDX-License-Identifier: MIT
// PNG images, with the checksum of each chunk put right: else nearly every change would end there.
#include <zlib.h>

#include <string>

#include "host/errors/input_error.hpp"
#include "host/maps/map_image.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace {

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

void put_checksums_right(std::string& png) {
  constexpr std::size_t signature = 8, length = 4, type = 4, checksum = 4;
  std::size_t at = signature;
  while (png.size() >= at + length + type + checksum) {
    const std::size_t content = big_endian(png, at);
    const std::size_t end = at + length + type + content;
    if (end + checksum > png.size()) return;
    const auto* begin = reinterpret_cast<const Bytef*>(png.data() + at + length);
    const auto sum = static_cast<std::uint32_t>(crc32(0, begin, static_cast<uInt>(type + content)));
    for (std::size_t i = 0; i < checksum; ++i) png[end + i] = static_cast<char>(sum >> (24 - 8 * i) & 0xff);
    at = end + checksum;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string png(dmrp::fuzz::text(data, size));
  put_checksums_right(png);
  try {
    dmrp::host::read_png(png, "image.png");
  } catch (const dmrp::host::InputError&) {
  }
  return 0;
}
