// SPDX-License-Identifier: MIT
// instance.hpp: an instance of any odd plugin: what its parameter `does` asks for.
#pragma once

#include <dmrp/plugin.h>

#include <array>
#include <cstdint>
#include <string>

// What `does` may be, besides what the functions of one kind know:
//
//   FUNCTION STATUS    the function returns this number
//   newer              its structs and array elements are longer than the host's
//   short STRUCT       these structs, or array elements, are shorter than v1.0's
//   overrun FUNCTION   the function writes beyond its output
struct dmrp_instance {
  const dmrp_host* host;
  std::string does;
  std::int32_t robot = DMRP_NO_ROBOT;
  const dmrp_world* world = nullptr;
  alignas(8) std::array<std::uint8_t, 256> table{};  // a function table of another size

  bool is(const std::string& what) const { return does == what; }

  // The rest of `does` after this first word; "" if it begins otherwise.
  std::string after(const std::string& word) const {
    return does.rfind(word + " ", 0) == 0 ? does.substr(word.size() + 1) : "";
  }

  std::int32_t status_of(const char* function) const {
    const std::string status = after(function);
    return status.empty() ? DMRP_OK : std::stoi(status);
  }

  // How many bytes more than in its header a struct has. Strides are multiples of 8, but for odd ones.
  int extra(const std::string& what) const {
    return is("newer") ? 24 : is("short " + what) ? -8 : is("odd stride " + what) ? 12 : 0;
  }

  void log(const std::string& text) const { host->log(host, DMRP_LOG_INFO, text.c_str()); }

  std::int32_t error(const std::string& text) const {
    host->set_error(host, text.c_str());
    return DMRP_ERROR;
  }

  const void* extension(const char* id) const { return host->get_extension(host, id); }
};
