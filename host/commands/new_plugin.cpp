// SPDX-License-Identifier: MIT
// Writes a plugin's folder from the installed templates: the files of templates/common and of templates/KIND. They
// build as they are, under the names `org.example.my_plugin` and `my_plugin`; here these become the author's.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/errors/input_error.hpp"
#include "host/errors/machine_error.hpp"
#include "host/files/read_file.hpp"
#include "host/files/shell_word.hpp"
#include "host/program/executable.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

struct NewOptions {
  std::string kind;  // a folder of the templates
  std::string id;    // of the new plugin
  fs::path folder;
  bool python = false;
};

constexpr const char* common_files = "common";
constexpr const char* python_templates = "python";  // a folder of such folders

// The folders of templates, but those that are no kind.
std::vector<std::string> template_kinds(const fs::path& templates) {
  std::vector<std::string> kinds;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(templates, missing))
    if (entry.is_directory() && entry.path().filename() != common_files && entry.path().filename() != python_templates)
      kinds.push_back(entry.path().filename());
  if (kinds.empty())
    throw InputError("dmrp-host new: no templates in " + templates.string() + " (Debian package dmrp-sdk-dev)");
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

void check_kind(const std::string& kind, const std::vector<std::string>& kinds) {
  if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) return;
  throw InputError(fmt::format("dmrp-host new: there is no kind of plugin '{}'{}: it is one of {}", kind,
                               did_you_mean(kind, kinds), join_names(kinds)));
}

bool is_id_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
}

void check_id(const std::string& id) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("dmrp-host new: --id '{}' {}: an id is a name under a domain of yours, as in '{}'", id,
                                 why, "org.example.mine"));
  };
  if (!std::all_of(id.begin(), id.end(), is_id_character))
    refuse("has characters other than letters, digits, '.', '_' and '-'");
  if (id.find('.') == std::string::npos) refuse("has no '.'");
  if (id.front() == '.' || id.back() == '.' || id.find("..") != std::string::npos) refuse("has an empty part");
  if (id.starts_with("dmrp.")) refuse("begins with 'dmrp.', which is for the built-in plugins");
}

// The last part of the id, as a name for files and for a target of CMake.
std::string file_name_of(const std::string& id) {
  std::string name = id.substr(id.rfind('.') + 1);
  std::replace(name.begin(), name.end(), '-', '_');
  const std::vector<std::string> targets_of_cmake = {"all", "clean", "help", "install", "package", "test"};
  const bool taken = std::find(targets_of_cmake.begin(), targets_of_cmake.end(), name) != targets_of_cmake.end();
  return taken ? name + "_plugin" : name;
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
    text.replace(at, old.size(), by);
  return text;
}

// Names as the author chose them.
struct Names {
  std::string kind;
  std::string id;
  std::string file_name;

  std::string in(const std::string& text) const {
    // id and prefix in two steps: they may contain the template's own names
    const std::string marked = replaced(replaced(text, "org.example.my_plugin", "\x01"), "my_prefix", "\x02");
    const std::string named = replaced(replaced(marked, "my_plugin", file_name), "my_kind", replaced(kind, "-", " "));
    return replaced(replaced(named, "\x02", installation_path().string()), "\x01", id);
  }
};

void write_new_file(const fs::path& file, const std::string& content) {
  fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << content;
  out.close();
  if (!out) throw MachineError("cannot write " + file.string());
}

// The relative paths of what it wrote.
std::vector<std::string> write_files(const fs::path& from, const fs::path& to, const Names& names) {
  std::vector<std::string> written;
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    if (!entry.is_regular_file()) continue;
    std::string relative = names.in(fs::relative(entry.path(), from).string());
    if (relative == "gitignore") relative = ".gitignore";  // packages hold no file of that name
    write_new_file(to / relative, names.in(read_file(entry.path(), entry.path().string())));
    written.push_back(relative);
  }
  return written;
}

void check_folder(const fs::path& folder) {
  std::error_code none;
  if (!fs::exists(folder, none)) return;
  if (!fs::is_directory(folder)) throw InputError("dmrp-host new: " + folder.string() + " is no folder");
  if (!fs::is_empty(folder)) throw InputError("dmrp-host new: " + folder.string() + " is not empty");
}

int new_command(const NewOptions& options) {
  const fs::path templates = shared_data_path() / "templates" / (options.python ? python_templates : "");
  check_kind(options.kind, template_kinds(templates));
  check_id(options.id);
  check_folder(options.folder);

  const Names names = {options.kind, options.id, file_name_of(options.id)};
  std::vector<std::string> written;
  try {
    written = write_files(templates / common_files, options.folder, names);
    for (const std::string& file : write_files(templates / options.kind, options.folder, names))
      written.push_back(file);
  } catch (const fs::filesystem_error& error) {
    throw_path_error("dmrp-host new: " + options.folder.string(), error.code());
  }
  std::sort(written.begin(), written.end());
  fmt::print("{}: {}\n", options.folder.string(), fmt::join(written, ", "));
  if (options.python) {
    fmt::print("  cd {} && dmrp-host {}.toml\n", shell_word(options.folder.string()), names.file_name);
    return exit_status::done;
  }
  fmt::print("  cd {} && cmake -S . -B build && cmake --build build && ctest --test-dir build\n",
             shell_word(options.folder.string()));
  return exit_status::done;
}

}  // namespace

void add_new(CLI::App& app) {
  const auto options = std::make_shared<NewOptions>();
  CLI::App* command = app.add_subcommand("new", "write the folder of a new plugin, which builds and runs at once");
  command->add_option("kind", options->kind, "planner, controller, pedestrian-model or metric")
      ->required()
      ->type_name("KIND");
  command->add_option("--id", options->id, "id of the plugin, under a domain of yours: org.example.mine")
      ->required()
      ->type_name("ID");
  command->add_flag("--python", options->python, "in Python: nothing is built");
  command->add_option("folder", options->folder, "folder to create; an empty one may be there")
      ->required()
      ->type_name("DIR");
  finish_command(command, "dmrp-host new planner --id org.example.mine mine",
                 [options] { return new_command(*options); });
}

}  // namespace dmrp::host
