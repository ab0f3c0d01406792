// SPDX-License-Identifier: MIT
#include "host/plugins/elf_file.hpp"

#include <elf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "host/files/sha256.hpp"
#include "host/plugins/python_file.hpp"
#include "host/program/executable.hpp"

namespace dmrp::host {

namespace {

#if defined(__aarch64__)
constexpr std::uint16_t this_machine = EM_AARCH64;
#else
constexpr std::uint16_t this_machine = EM_X86_64;
#endif

constexpr std::uint64_t most_name_bytes = 65536;

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

bool names_folders(const Elf64_Dyn& entry) {
  return entry.d_tag == DT_RUNPATH || entry.d_tag == DT_RPATH;
}

// What the loader maps, as it finds it: by program headers, not by sections, which nobody loads.
class LoadedParts {
 public:
  LoadedParts(ElfFile& elf, const Elf64_Ehdr& head) : elf_(elf) {
    for (unsigned i = 0; i < head.e_phnum; ++i) {
      const auto part = elf.read<Elf64_Phdr>(head.e_phoff + std::uint64_t{i} * head.e_phentsize);
      if (!part) break;
      if (part->p_type == PT_LOAD) segments_.push_back(*part);
      if (part->p_type == PT_NOTE) blanks_.push_back({part->p_offset, part->p_filesz});  // the build's number
      if (part->p_type == PT_DYNAMIC) read_dynamic(*part);
    }
    // where the sections are, which a stripped file has elsewhere
    constexpr std::uint64_t after_flags = offsetof(Elf64_Ehdr, e_shentsize);
    blanks_.push_back({offsetof(Elf64_Ehdr, e_shoff), sizeof(head.e_shoff)});
    blanks_.push_back({after_flags, sizeof(head) - after_flags});
    blank_folders();
  }

  const std::vector<Elf64_Phdr>& segments() const { return segments_; }

  // Without the folders in which libraries are searched.
  const std::vector<Elf64_Dyn>& dynamic() const { return dynamic_; }

  // The libraries that it needs, by name, and the folders in which it has them searched, as written.
  std::vector<std::string> needed() const {
    std::vector<std::string> names;
    for (const Elf64_Dyn& entry : dynamic_)
      if (entry.d_tag == DT_NEEDED) names.push_back(string_at(entry.d_un.d_val));
    return names;
  }
  std::vector<std::string> folders() const {
    std::vector<std::string> out;
    for (const std::uint64_t place : folders_) {
      std::istringstream list(string_at(place));
      for (std::string folder; std::getline(list, folder, ':');) out.push_back(folder);
    }
    return out;
  }

  // Overwrites what may differ between two copies of a library.
  void blank(const Elf64_Phdr& segment, std::string& content) const {
    for (const Range& range : blanks_) {
      const std::uint64_t begin = std::max(range.offset, segment.p_offset);
      const std::uint64_t end = std::min(range.offset + range.bytes, segment.p_offset + content.size());
      if (begin < end)
        std::fill_n(content.begin() + static_cast<std::ptrdiff_t>(begin - segment.p_offset), end - begin, '\0');
    }
  }

 private:
  struct Range {
    std::uint64_t offset;
    std::uint64_t bytes;
  };

  std::string string_at(std::uint64_t place) const {
    const auto strings = rest_of_strings(place);
    return strings ? elf_.text(strings->offset, std::min(strings->bytes, most_name_bytes)).c_str() : "";
  }

  void read_dynamic(const Elf64_Phdr& part) {
    blanks_.push_back({part.p_offset, part.p_filesz});
    for (std::uint64_t at = 0; at + sizeof(Elf64_Dyn) <= part.p_filesz; at += sizeof(Elf64_Dyn)) {
      const auto entry = elf_.read<Elf64_Dyn>(part.p_offset + at);
      if (!entry || entry->d_tag == DT_NULL) break;
      if (names_folders(*entry))
        folders_.push_back(entry->d_un.d_val);
      else
        dynamic_.push_back(*entry);
      if (entry->d_tag == DT_STRTAB) strings_ = entry->d_un.d_ptr;
    }
  }

  // Returns what lies between a place in the table of strings and the end of its segment.
  std::optional<Range> rest_of_strings(std::uint64_t place) const {
    const std::uint64_t address = strings_ + place;
    for (const Elf64_Phdr& segment : segments_)
      if (address >= segment.p_vaddr && address < segment.p_vaddr + segment.p_filesz)
        return Range{segment.p_offset + (address - segment.p_vaddr), segment.p_filesz - (address - segment.p_vaddr)};
    return std::nullopt;
  }

  // A shorter text may stand in the place of a longer one, with zeros after it.
  void blank_folders() {
    for (const std::uint64_t folder : folders_)
      if (const auto strings = rest_of_strings(folder)) {
        const std::string rest = elf_.text(strings->offset, strings->bytes);
        const std::size_t end = std::min(rest.find_first_not_of('\0', rest.find('\0')), rest.size());
        blanks_.push_back({strings->offset, end});
      }
  }

  ElfFile& elf_;
  std::vector<Elf64_Phdr> segments_;
  std::vector<Elf64_Dyn> dynamic_;
  std::vector<std::uint64_t> folders_;  // in the table of strings
  std::uint64_t strings_ = 0;
  std::vector<Range> blanks_;
};

bool is_visible(const Elf64_Sym& symbol) {
  const unsigned binding = ELF64_ST_BIND(symbol.st_info);
  const unsigned visibility = ELF64_ST_VISIBILITY(symbol.st_other);
  return symbol.st_shndx != SHN_UNDEF && (binding == STB_GLOBAL || binding == STB_WEAK || binding == STB_GNU_UNIQUE) &&
         (visibility == STV_DEFAULT || visibility == STV_PROTECTED);
}

}  // namespace

std::string why_not_loadable(const std::filesystem::path& file) {
  if (is_python_file(file)) return "";
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
  if (!head || std::memcmp(head->e_ident, ELFMAG, SELFMAG) != 0) return sha256_of_file(file);
  const LoadedParts parts(elf, *head);
  Sha256 hash;
  for (const Elf64_Phdr& segment : parts.segments()) {
    std::string content = elf.text(segment.p_offset, segment.p_filesz);
    parts.blank(segment, content);
    for (const std::uint64_t number :
         {segment.p_vaddr, segment.p_filesz, segment.p_memsz, std::uint64_t{segment.p_flags}})
      hash.add(&number, sizeof(number));
    hash.add(content.data(), content.size());
  }
  for (const Elf64_Dyn& entry : parts.dynamic()) hash.add(&entry, sizeof(entry));
  return hash.finish();
}

namespace {

// Puts the folder of the library in the place of $ORIGIN.
std::filesystem::path expanded(std::string folder, const std::filesystem::path& library) {
  for (const std::string word : {"${ORIGIN}", "$ORIGIN"})
    if (const std::size_t at = folder.find(word); at != std::string::npos)
      folder.replace(at, word.size(), library.parent_path().string());
  return folder;
}

// Not a file that is no library: plugins would see it without loading it.
void add_files_of(const std::filesystem::path& library, std::set<std::filesystem::path>& files) {
  ElfFile elf(library);
  const auto head = elf.read<Elf64_Ehdr>(0);
  if (!head || std::memcmp(head->e_ident, ELFMAG, SELFMAG) != 0 || !files.insert(library).second) return;
  const LoadedParts parts(elf, *head);
  std::vector<std::filesystem::path> folders = folders_of_variable("LD_LIBRARY_PATH");
  for (const std::string& folder : parts.folders()) folders.push_back(expanded(folder, library));
  for (const std::string& name : parts.needed()) {
    if (name.find('/') != std::string::npos) add_files_of(name, files);
    for (const std::filesystem::path& folder : folders)
      if (std::error_code ignored; std::filesystem::is_regular_file(folder / name, ignored))
        add_files_of(folder / name, files);
  }
}

}  // namespace

std::vector<std::filesystem::path> files_of_library(const std::filesystem::path& file) {
  std::set<std::filesystem::path> files;
  add_files_of(file, files);
  return {files.begin(), files.end()};
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
