// SPDX-License-Identifier: MIT
#include "host/plugins/library.hpp"

#include <fmt/format.h>
#include <link.h>

#include <boost/dll/shared_library.hpp>
#include <set>
#include <stdexcept>

#include "host/errors/escaped_text.hpp"
#include "host/plugins/calls/fp_control.hpp"
#include "host/plugins/check_descriptor.hpp"
#include "host/plugins/elf_file.hpp"
#include "host/plugins/offered_extensions.hpp"
#include "host/plugins/python_file.hpp"
#include "host/plugins/v1_sizes.hpp"
#include "host/program/executable.hpp"

namespace dmrp::host {

struct Library::Handle {
  boost::dll::shared_library library;
};

namespace {

// The loader's message without the path, which the caller prints, and without Boost's text.
std::string loader_message(const std::exception& error, const std::filesystem::path& file) {
  std::string text = error.what();
  if (const auto at = text.find(file.string()); at != std::string::npos) {
    text = text.substr(at + file.string().size());
    text.erase(0, text.find_first_not_of(": "));
  }
  // Boost says "... (dlerror system message: WHY): Bad file descriptor [system:9]" whatever the reason
  if (const auto end = text.rfind("): "); end != std::string::npos) text.erase(end);
  return text;
}

// The files of all shared objects of this process.
std::set<std::string> loaded_objects() {
  std::set<std::string> all;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* out) {
        std::error_code error;
        const auto file =
            std::filesystem::canonical(info->dlpi_name, error);  // not the program, and what the kernel maps
        if (!error) static_cast<std::set<std::string>*>(out)->insert(file);
        return 0;
      },
      &all);
  return all;
}

dmrp_entry copy_entry(const dmrp_entry& theirs) {
  // The draft first: the entry of another draft may have another size.
  constexpr std::size_t up_to_draft = offsetof(dmrp_entry, abi_draft) + sizeof(theirs.abi_draft);
  if (theirs.struct_size < up_to_draft) throw std::runtime_error("its dmrp_entry_v1 is shorter than v1.0's");
  if (theirs.abi_draft != DMRP_ABI_DRAFT)
    throw std::runtime_error(
        fmt::format("built for draft {} of the v1 contract, this host has draft {}: build it again", theirs.abi_draft,
                    DMRP_ABI_DRAFT));
  if (!has_v1_0<dmrp_entry>(theirs.struct_size)) throw std::runtime_error("its dmrp_entry_v1 is shorter than v1.0's");
  const dmrp_entry ours = copy_struct(theirs);
  if (ours.min_host_minor > DMRP_ABI_MINOR)
    throw std::runtime_error(
        fmt::format("needs a host of ABI 1.{} or newer, this is 1.{}", ours.min_host_minor, DMRP_ABI_MINOR));
  if (!ours.init || !ours.deinit || !ours.plugin_count || !ours.descriptor || !ours.create)
    throw std::runtime_error("its dmrp_entry_v1 lacks a function");
  return ours;
}

// Why there is no entry of this contract.
std::string missing_entry(const std::function<bool(const char*)>& has) {
  constexpr int newest_major = 9;  // further than this contract will come
  for (int major = 0; major <= newest_major; ++major)
    if (major != DMRP_ABI_MAJOR && has(fmt::format("dmrp_entry_v{}", major).c_str()))
      return fmt::format("built for v{} of the contract, this host speaks v{}: build it with this host's SDK", major,
                         DMRP_ABI_MAJOR);
  return "not a dmrp v1 plugin (no symbol " DMRP_ENTRY_SYMBOL
         "): end it with DMRP_PLUGINS(...) or DMRP_ENTRY, and build it with dmrp_add_plugin()";
}

}  // namespace

Library::Library(const std::filesystem::path& file, const std::function<void(const std::string&)>& stage)
    : handle_(std::make_unique<Handle>()), file_(std::filesystem::absolute(file)) {
  if (const std::string why = why_not_loadable(file); !why.empty()) throw std::runtime_error(why);
  if (is_python_file(file))
    import(stage);
  else
    load(stage);
  entry_ = copy_entry(*own_entry_);
  read_descriptors(stage);
}

void Library::import(const std::function<void(const std::string&)>& stage) {
  const PythonFunctions* const python = python_functions();
  if (!python) throw std::runtime_error("is a Python file, which only a process of its own can load");
  if (stage) stage("import");
  own_entry_ = python->open(file_.c_str());
  if (!own_entry_) throw std::runtime_error(python->error());
}

void Library::load(const std::function<void(const std::string&)>& stage) {
  const std::uint32_t control_bits = fp_control();
  const std::set<std::string> before = loaded_objects();
  if (stage) stage("dlopen");
  try {
    handle_->library.load(file_, boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot be loaded: " + loader_message(error, file_));
  }
  for (const std::string& object : loaded_objects())
    if (!before.contains(object) && std::filesystem::path(object) != file_) objects_.push_back(object);
  if (fp_control() != control_bits) {
    set_fp_control(control_bits);
    warnings_.push_back(
        "changed the floating-point control bits when it was loaded (built with -ffast-math?); they were restored");
  }
  if (!handle_->library.has(DMRP_ENTRY_SYMBOL))
    throw std::runtime_error(missing_entry([&](const char* symbol) { return handle_->library.has(symbol); }));
  own_entry_ = &handle_->library.get<const dmrp_entry>(DMRP_ENTRY_SYMBOL);
}

std::vector<std::string> Library::objects() const {
  return is_python_file(file_) ? lines_of(python_functions()->modules()) : objects_;
}

std::vector<std::string> Library::runtime() const {
  return is_python_file(file_) ? lines_of(python_functions()->versions()) : std::vector<std::string>();
}

void Library::read_descriptors(const std::function<void(const std::string&)>& stage) {
  if (stage) stage("plugin_count()");
  const std::uint32_t count = plugin_count();
  if (count == 0) throw std::runtime_error("holds no plugin");
  const bool built_in = !is_python_file(file_) && !name_of_own_library(file_).empty();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (stage) stage(fmt::format("descriptor({})", i));
    const dmrp_descriptor* descriptor = this->descriptor(i);
    if (!descriptor) throw std::runtime_error(fmt::format("gives no descriptor for its plugin {}", i));
    PluginInfo info = copy_descriptor(*descriptor);
    if (const std::string part = unknown_part(info); !part.empty()) {
      warnings_.push_back(fmt::format("its plugin '{}' is left out: it {}, which this host does not know",
                                      escaped(info.id.c_str()), part));
      continue;
    }
    check_descriptor(info);
    if (is_reserved_id(info.id) && !built_in)
      throw std::runtime_error(fmt::format(
          "has a plugin with the id '{}': ids that begin with 'dmrp.' are for the built-in plugins", info.id));
    for (std::string& warning : doubtful_extensions(info)) warnings_.push_back(std::move(warning));
    plugins_.push_back(std::move(info));
  }
}

Library::~Library() {
  // thread-local and static objects may still refer to the library's code: it stays mapped
  static std::vector<boost::dll::shared_library> kept;
  kept.push_back(std::move(handle_->library));
}

}  // namespace dmrp::host
