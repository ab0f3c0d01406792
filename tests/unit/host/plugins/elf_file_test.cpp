// SPDX-License-Identifier: MIT
// The digest of a library's code is over what the loader maps, whatever the file says of its sections.
#include "host/plugins/elf_file.hpp"

#include <elf.h>

#include <catch2/catch.hpp>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace elf_file_test {

using dmrp::host::code_digest;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string digest_of(const std::string& bytes) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "dmrp_elf_file_test.so";
  std::ofstream(file, std::ios::binary) << bytes;
  const std::string digest = code_digest(file);
  std::filesystem::remove(file);
  return digest;
}

// As a file whose sections nobody finds.
std::string without_sections(std::string bytes) {
  Elf64_Ehdr head;
  std::memcpy(&head, bytes.data(), sizeof(head));
  head.e_shoff = 0;
  head.e_shnum = 1;
  head.e_shstrndx = 0;
  std::memcpy(bytes.data(), &head, sizeof(head));
  return bytes;
}

// The middle of the code that is mapped to be executed.
std::size_t place_in_code(const std::string& bytes) {
  Elf64_Ehdr head;
  std::memcpy(&head, bytes.data(), sizeof(head));
  for (unsigned i = 0; i < head.e_phnum; ++i) {
    Elf64_Phdr part;
    std::memcpy(&part, bytes.data() + head.e_phoff + i * sizeof(part), sizeof(part));
    if (part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0) return part.p_offset + part.p_filesz / 2;
  }
  throw std::runtime_error("no code");
}

TEST_CASE("a digest is over what is loaded") {
  const std::string bytes = bytes_of(DMRP_ODD_PLUGINS);
  const std::string digest = digest_of(bytes);
  CHECK(digest.size() == 64);
  CHECK(digest == code_digest(DMRP_ODD_PLUGINS));
  CHECK(digest_of(without_sections(bytes)) == digest);
  CHECK(digest_of(bytes + "not loaded") == digest);

  std::string changed = bytes;
  changed[place_in_code(bytes)] ^= 1;
  CHECK(digest_of(changed) != digest);
  CHECK(digest_of(without_sections(changed)) == digest_of(changed));
}

TEST_CASE("damaged files have a digest, too") {
  const std::string bytes = bytes_of(DMRP_ODD_PLUGINS);
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, sizeof(Elf64_Ehdr), bytes.size() / 2})
    CHECK(digest_of(bytes.substr(0, size)).size() == 64);
  std::string far = bytes;
  Elf64_Ehdr head;
  std::memcpy(&head, far.data(), sizeof(head));
  head.e_phoff = ~std::uint64_t{0} - 8;
  std::memcpy(far.data(), &head, sizeof(head));
  CHECK(digest_of(far).size() == 64);
}

}  // namespace elf_file_test
