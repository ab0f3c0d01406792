// SPDX-License-Identifier: MIT
#include "host/report/replay/page_packing.hpp"

#include <openssl/evp.h>
#include <zlib.h>

#include <limits>
#include <stdexcept>

namespace dmrp::host {

std::string gzip(std::string_view text) {
  constexpr int gzip_window_bits = 15 + 16;  // 16 selects the format gzip instead of zlib
  constexpr int memory_level = 9;
  if (text.size() > std::numeric_limits<uInt>::max()) throw std::runtime_error("too much text for a page");
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, gzip_window_bits, memory_level, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib cannot compress");
  std::string packed(deflateBound(&stream, static_cast<uLong>(text.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int status = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib cannot compress");
  return packed;
}

std::string base64(std::string_view bytes) {
  if (bytes.size() > std::numeric_limits<int>::max()) throw std::runtime_error("too much text for a page");
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');  // with OpenSSL's terminating zero
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), reinterpret_cast<const unsigned char*>(bytes.data()),
                  static_cast<int>(bytes.size()));
  text.pop_back();
  return text;
}

}  // namespace dmrp::host
