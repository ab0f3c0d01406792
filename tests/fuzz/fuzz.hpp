// SPDX-License-Identifier: MIT
// fuzz.hpp: what the fuzzers share. Each has LLVMFuzzerTestOneInput(): whatever the bytes are, the reader accepts them
// or throws the errors that its header names. Everything else, other exceptions too, ends the fuzzer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace dmrp::fuzz {

inline std::string_view text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// An input of two files: what stands before the first line "%%", and what follows it.
inline std::pair<std::string_view, std::string_view> two_files(std::string_view input) {
  constexpr std::string_view border = "\n%%\n";
  const auto at = input.find(border);
  if (at == std::string_view::npos) return {input, {}};
  return {input.substr(0, at + 1), input.substr(at + border.size())};
}

inline void write_file(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace dmrp::fuzz
