// SPDX-License-Identifier: MIT
#include "host/process/view.hpp"

#include <fcntl.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "host/errors/machine_error.hpp"
#include "host/process/descriptor.hpp"

namespace dmrp::host::view {

namespace {

namespace fs = std::filesystem;

constexpr const char* known_variable = "DMRP_VIEW";  // what gap() has found; children inherit it
constexpr const char* whole = "whole";
constexpr const char* old_root = "/old";
constexpr const char* cover = "size=64k,nr_inodes=64,mode=755";  // of a folder that is not shown
constexpr const char* scratch_size = "size=64m,nr_inodes=4096,mode=700";

// What plugins of any origin need: programs, libraries, interpreters.
constexpr std::array system_paths = {
    "/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32", "/opt", "/nix/store", "/gnu/store",
    "/etc/ld.so.cache", "/etc/alternatives",
    // which processors there are: libraries choose their code by it, and some refuse to run without
    "/proc/cpuinfo", "/sys/devices/system/cpu"};
constexpr std::array devices = {"/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom"};

// It is that of <linux/mount.h>, which older C libraries' <sys/mount.h> excludes.
struct MountAttributes {
  std::uint64_t set = 0;
  std::uint64_t clear = 0;
  std::uint64_t propagation = 0;
  std::uint64_t user_namespace = 0;
};
constexpr std::uint64_t read_only = 0x1;
constexpr std::uint64_t no_set_user_id = 0x2;
constexpr std::uint64_t no_devices = 0x4;

void check(long result, const std::string& what) {
  if (result < 0) throw MachineError("namespaces: " + what, errno);
}

void write_file(const char* path, const std::string& text) {
  const Descriptor file(open(path, O_WRONLY | O_CLOEXEC));
  check(file.is_open() ? 0 : -1, path);
  check(write(file.number(), text.data(), text.size()), path);
}

void mount_temporary(const char* where, const char* options) {
  check(mount("dmrp", where, "tmpfs", MS_NOSUID | MS_NODEV, options), where);
}

void restrict_mount(const std::string& where, std::uint64_t attributes, unsigned flags) {
  const MountAttributes change = {attributes};
  check(syscall(SYS_mount_setattr, AT_FDCWD, where.c_str(), flags, &change, sizeof(change)), where);
}

enum class Kind { link, folder_or_file, files, device };

// A path of the machine, and the file that it leads to. `files`: a folder without its subfolders.
struct Shown {
  fs::path path;
  fs::path file;
  Kind kind;
};

bool is_within(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// From an experiment or its results a plugin would know the future.
bool is_of_a_run(const fs::path& file) {
  const fs::path kind = file.extension();
  return kind == ".toml" || kind == ".sqlite" || kind == ".mcap";
}

class Entries {
 public:
  explicit Entries(const std::vector<std::string>& visible) {
    for (const char* const path : system_paths) add(path, fs::is_symlink(path) ? Kind::link : Kind::folder_or_file);
    for (const char* const path : devices) add(path, Kind::device);
    for (const std::string& path : visible)
      if (fs::path(path).filename() == all_files)
        add(fs::path(path).parent_path(), Kind::files);
      else
        add(path, Kind::folder_or_file);
  }

  const std::vector<Shown>& all() const { return all_; }

 private:
  // What is gone is not shown, nor what would take the place of temporary files; what is in a shown folder is shown already.
  void add(const fs::path& written, Kind kind) {
    std::error_code missing;
    const fs::path path = written.lexically_normal();
    const fs::path file = fs::canonical(path, missing);
    const bool is_shown = std::any_of(all_.begin(), all_.end(), [&](const Shown& other) {
      return other.kind == Kind::files
                 ? path.parent_path() == other.path && fs::is_regular_file(path) && !is_of_a_run(path)
                 : is_within(path, other.path);
    });
    if (!missing && !is_shown && file != "/" && path != scratch) all_.push_back({path, file, kind});
  }

  std::vector<Shown> all_;
};

void mount_unless_gone(const char* what, const fs::path& where, const char* type, unsigned long flags,
                       const char* options) {
  if (mount(what, where.c_str(), type, flags, options) != 0 && errno != ENOENT) check(-1, where);
}

void show(const Shown& entry) {
  if (entry.kind == Kind::link) return fs::create_symlink(entry.file, entry.path);
  const std::string from = old_root + entry.file.string();
  const std::string& to = entry.path.native();
  if (!fs::exists(to)) {
    fs::create_directories(entry.path.parent_path());
    if (fs::is_directory(from))
      fs::create_directory(to);
    else
      Descriptor(open(to.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600)).close();
  }
  check(mount(from.c_str(), to.c_str(), nullptr, MS_BIND | MS_REC, nullptr), to);
  restrict_mount(to, read_only | no_set_user_id | (entry.kind == Kind::device ? 0 : no_devices), AT_RECURSIVE);
  if (entry.kind != Kind::files) return;
  for (const auto& inside : fs::directory_iterator(to)) {
    if (inside.is_symlink()) continue;  // it leads to one of the others, or to nothing
    if (inside.is_directory()) mount_unless_gone("dmrp", inside.path(), "tmpfs", MS_NOSUID | MS_NODEV, cover);
    if (is_of_a_run(inside.path())) mount_unless_gone("/dev/null", inside.path(), nullptr, MS_BIND, nullptr);
  }
}

// The new root takes the place of the old one, from which the entries come; then that goes.
void mount_view(const Entries& entries) {
  check(mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr), "/");
  mount_temporary(scratch, "size=1m,mode=755");
  const std::string place = std::string(scratch) + old_root;
  check(mkdir(place.c_str(), 0700), place);
  check(syscall(SYS_pivot_root, scratch, place.c_str()), "pivot_root");
  check(chdir("/"), "/");
  check(mkdir(scratch, 0700), scratch);
  mount_temporary(scratch, scratch_size);
  for (const Shown& entry : entries.all()) show(entry);
  check(umount2(old_root, MNT_DETACH), old_root);
  check(rmdir(old_root), old_root);
  restrict_mount("/", read_only, 0);
  check(chdir(scratch), scratch);
}

void drop_capabilities() {
  check(prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), "no_new_privs");  // programs get none either
  __user_cap_header_struct header = {_LINUX_CAPABILITY_VERSION_3, 0};
  const std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> none{};
  check(syscall(SYS_capset, &header, none.data()), "capset");
}

std::string try_it() {
  const Pipe pipe = make_pipe();
  const pid_t child = fork();
  if (child < 0) return "fork: " + std::string(std::strerror(errno));
  if (child == 0) {
    std::string text;
    try {
      leave({});
    } catch (const std::exception& error) {
      text = error.what();
    }
    _exit(write(pipe.write_end.number(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? 0 : 1);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0) return "namespaces: cannot be tried";
  std::array<char, 256> text{};
  if (fcntl(pipe.read_end.number(), F_SETFL, O_NONBLOCK) != 0) return "fcntl";
  const ssize_t count = read(pipe.read_end.number(), text.data(), text.size());
  return std::string(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
}

}  // namespace

std::string gap() {
  const char* known = std::getenv(known_variable);
  if (!known) {
    const std::string why = try_it();
    setenv(known_variable, why.empty() ? whole : why.c_str(), 1);
    known = std::getenv(known_variable);
  }
  return std::strcmp(known, whole) == 0 ? "" : known;
}

void leave(const std::vector<std::string>& visible) {
  const std::string user = std::to_string(getuid());
  const std::string group = std::to_string(getgid());
  const Entries entries(visible);
  prctl(PR_SET_DUMPABLE, 1);  // otherwise the maps belong to somebody else
  check(unshare(CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNS | CLONE_NEWIPC | CLONE_NEWNET), "unshare");
  write_file("/proc/self/setgroups", "deny");
  write_file("/proc/self/uid_map", user + " " + user + " 1");
  write_file("/proc/self/gid_map", group + " " + group + " 1");
  try {
    mount_view(entries);
  } catch (const fs::filesystem_error& error) {
    throw MachineError("namespaces: " + error.path1().string(), error.code().value());
  }
  drop_capabilities();
}

}  // namespace dmrp::host::view
