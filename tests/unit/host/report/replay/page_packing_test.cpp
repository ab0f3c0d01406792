// SPDX-License-Identifier: MIT
#include "host/report/replay/page_packing.hpp"

#include <zlib.h>

#include <catch2/catch.hpp>
#include <string>

namespace page_packing_test {

using namespace dmrp;
using namespace dmrp::host;

std::string unzipped(const std::string& packed) {
  z_stream stream{};
  REQUIRE(inflateInit2(&stream, 15 + 16) == Z_OK);
  std::string text(10'000'000, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  REQUIRE(inflate(&stream, Z_FINISH) == Z_STREAM_END);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

TEST_CASE("gzip is lossless and deterministic", "[report]") {
  const std::string text = "a\0b" + std::string(100'000, 'x') + "\xff";
  CHECK(unzipped(gzip(text)) == text);
  CHECK(gzip(text) == gzip(text));
  CHECK(gzip(text).size() < 1000);
  CHECK(unzipped(gzip("")).empty());
}

TEST_CASE("base64 matches RFC 4648, section 10", "[report]") {
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string("\0\xff\xfe", 3)) == "AP/+");
}

}  // namespace page_packing_test
