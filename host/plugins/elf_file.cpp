// SPDX-License-Identifier: MIT
#include "host/plugins/elf_file.hpp"

#include <elf.h>
#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <optional>

#include "host/files/sha256.hpp"

namespace dmrp::host {

namespace {

#if defined(__aarch64__)
constexpr std::uint16_t this_machine = EM_AARCH64;
#else
constexpr std::uint16_t this_machine = EM_X86_64;
#endif

std::string machine_name(std::uint16_t machine) {
  switch (machine) {
    case EM_X86_64:
      return "x86_64";
    case EM_AARCH64:
      return "aarch64";
    case EM_386:
      return "i386";
    case EM_ARM:
      return "arm";
    case EM_RISCV:
      return "riscv";
    case EM_PPC64:
      return "ppc64";
    default:
      return fmt::format("machine {}", machine);
  }
}

// Offsets of a damaged file may lie anywhere: every read is checked.
class ElfFile {
 public:
  explicit ElfFile(const std::filesystem::path& file) : in_(file, std::ios::binary) {
    in_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(in_.tellg(), 0));
  }

  template <class Struct>
  std::optional<Struct> read(std::uint64_t offset) {
    Struct out{};
    return read_bytes(offset, &out, sizeof(out)) ? std::optional(out) : std::nullopt;
  }

  std::string text(std::uint64_t offset, std::uint64_t most_bytes) {
    if (offset >= size_) return "";
    std::string out(std::min(most_bytes, size_ - offset), '\0');
    read_bytes(offset, out.data(), out.size());
    return out;
  }

 private:
  bool read_bytes(std::uint64_t offset, void* to, std::uint64_t bytes) {
    if (offset > size_ || bytes > size_ - offset) return false;
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(offset));
    return static_cast<bool>(in_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes)));
  }

  std::ifstream in_;
  std::uint64_t size_ = 0;
};

bool is_visible(const Elf64_Sym& symbol) {
  const unsigned binding = ELF64_ST_BIND(symbol.st_info);
  const unsigned visibility = ELF64_ST_VISIBILITY(symbol.st_other);
  return symbol.st_shndx != SHN_UNDEF && (binding == STB_GLOBAL || binding == STB_WEAK || binding == STB_GNU_UNIQUE) &&
         (visibility == STV_DEFAULT || visibility == STV_PROTECTED);
}

}  // namespace

std::string why_not_loadable(const std::filesystem::path& file) {
  ElfFile elf(file);
  const auto head = elf.read<Elf64_Ehdr>(0);
  if (!head || std::memcmp(head->e_ident, ELFMAG, SELFMAG) != 0) return "is no shared object (it has no ELF header)";
  if (head->e_machine != this_machine)
    return fmt::format("is for {}, this host is {}: build it for this machine", machine_name(head->e_machine),
                       machine_name(this_machine));
  if (head->e_ident[EI_CLASS] != ELFCLASS64 || head->e_ident[EI_DATA] != ELFDATA2LSB)
    return "is no 64-bit little-endian object";
  if (head->e_type == ET_REL) return "is an object file, not a shared object: link it with -shared";
  if (head->e_type == ET_EXEC) return "is a program, not a shared object: link it with -shared";
  return "";
}

std::string code_digest(const std::filesystem::path& file) {
  ElfFile elf(file);
  const auto head = elf.read<Elf64_Ehdr>(0);
  const auto section = [&](std::uint64_t i) {
    return elf.read<Elf64_Shdr>(head->e_shoff + i * sizeof(Elf64_Shdr)).value_or(Elf64_Shdr{});
  };
  if (!head || std::memcmp(head->e_ident, ELFMAG, SELFMAG) != 0 || head->e_shnum == 0) return sha256_of_file(file);
  Sha256 hash;
  for (unsigned i = 0; i < head->e_shnum; ++i) {
    const Elf64_Shdr one = section(i);
    const bool is_program = one.sh_type == SHT_PROGBITS || one.sh_type == SHT_INIT_ARRAY ||
                            one.sh_type == SHT_FINI_ARRAY || one.sh_type == SHT_RELA;
    if (!is_program || (one.sh_flags & SHF_ALLOC) == 0) continue;
    hash.add(&one.sh_addr, sizeof(one.sh_addr));
    const std::string content = elf.text(one.sh_offset, one.sh_size);
    hash.add(content.data(), content.size());
  }
  return hash.finish();
}

std::vector<ExportedSymbol> exported_symbols(const std::filesystem::path& file) {
  std::vector<ExportedSymbol> out;
  ElfFile elf(file);
  const auto head = elf.read<Elf64_Ehdr>(0);
  if (!head) return out;
  for (unsigned i = 0; i < head->e_shnum; ++i) {
    const auto table = elf.read<Elf64_Shdr>(head->e_shoff + std::uint64_t{i} * sizeof(Elf64_Shdr));
    if (!table || table->sh_type != SHT_DYNSYM) continue;
    const auto strings = elf.read<Elf64_Shdr>(head->e_shoff + std::uint64_t{table->sh_link} * sizeof(Elf64_Shdr));
    if (!strings) continue;
    const std::string names = elf.text(strings->sh_offset, strings->sh_size);
    for (std::uint64_t at = 0; at + sizeof(Elf64_Sym) <= table->sh_size; at += sizeof(Elf64_Sym)) {
      const auto symbol = elf.read<Elf64_Sym>(table->sh_offset + at);
      if (!symbol) break;
      if (symbol->st_name < names.size() && is_visible(*symbol))
        out.push_back({names.c_str() + symbol->st_name, ELF64_ST_BIND(symbol->st_info) != STB_GLOBAL});
    }
  }
  return out;
}

}  // namespace dmrp::host
