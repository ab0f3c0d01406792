// SPDX-License-Identifier: MIT
// sha256.hpp: SHA-256 digests, in hexadecimal.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // libcrypto's EVP_MD_CTX

namespace dmrp::host {

// The digest of bytes that come in parts.
class Sha256 {
 public:
  Sha256();
  void add(const void* bytes, std::size_t size);
  std::string finish();  // once, after the last part

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

std::string sha256_of_bytes(std::string_view bytes);
std::string sha256_of_file(const std::filesystem::path& path);  // throws std::system_error

}  // namespace dmrp::host
