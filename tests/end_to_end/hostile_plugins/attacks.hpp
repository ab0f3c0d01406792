// SPDX-License-Identifier: MIT
// attacks.hpp: what a plugin can do to the process that it runs in, and to others. Each starts one process at most.
#pragma once

#include <dirent.h>
#include <fcntl.h>
#include <fenv.h>
#include <linux/sockios.h>
#include <linux/userfaultfd.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace dmrp::test {

inline std::vector<int> open_descriptors() {
  constexpr int most = 1024;
  std::vector<int> numbers;
  for (int number = 0; number < most; ++number)
    if (fcntl(number, F_GETFD) >= 0) numbers.push_back(number);
  return numbers;
}

inline std::string target_of(int descriptor) {
  struct stat file {};
  if (fstat(descriptor, &file) == 0 && S_ISFIFO(file.st_mode)) return "pipe:";
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor), ignored);
}

// To every pipe that this process can write to.
inline void write_to_pipes(const std::string& text) {
  for (const int descriptor : open_descriptors())
    if (descriptor > 2 && target_of(descriptor).rfind("pipe:", 0) == 0) [[maybe_unused]]
      const ssize_t written = write(descriptor, text.data(), text.size());
}

inline void close_those(const std::string& part_of_target) {
  for (const int descriptor : open_descriptors())
    if (descriptor > 2 && target_of(descriptor).find(part_of_target) != std::string::npos) close(descriptor);
}

// Workers of the same run; where there is no /proc, the first process.
inline std::vector<int> siblings() {
  std::vector<int> numbers;
  const std::string parent = std::to_string(getppid());
  if (!std::filesystem::exists("/proc/self")) return {1};
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const int process = std::atoi(entry.path().filename().c_str());
    const std::string status = "/proc/" + std::to_string(process) + "/stat";
    const int file = process > 0 && process != getpid() ? open(status.c_str(), O_RDONLY) : -1;
    if (file < 0) continue;
    char text[512] = {};
    [[maybe_unused]] const ssize_t count = read(file, text, sizeof(text) - 1);
    close(file);
    const char* const after_name = std::strrchr(text, ')');
    if (after_name && std::string(after_name + 4).rfind(parent + " ", 0) == 0) numbers.push_back(process);
  }
  return numbers;
}

// Whether memory or files of another process of the run are open to this one. (Root reads environments all the same.)
inline bool sees_others() {
  std::vector<int> others = siblings();
  others.push_back(getppid());
  for (const int process : others)
    for (const char* const file : {"/mem", "/fd/0", "/cwd"})
      if (open(("/proc/" + std::to_string(process) + file).c_str(), O_RDONLY) >= 0) return true;
  return false;
}

// The kernel would signal the owner.
inline bool owns_for_parent() {
  const int ends = open("/dev/zero", O_RDONLY);
  const int parent = getppid();
  f_owner_ex owner = {F_OWNER_PID, parent};
  return fcntl(ends, F_SETOWN, parent) == 0 || fcntl(ends, F_SETOWN_EX, &owner) == 0 ||
         fcntl(ends, F_SETSIG, SIGKILL) == 0 || ioctl(0, FIOSETOWN, &parent) == 0;
}

inline bool types() {
  return open("/dev/tty", O_RDONLY) >= 0 || ioctl(0, TIOCSTI, "x") == 0 || errno != EPERM;
}

inline bool has_rings_or_segments() {
  char parameters[256] = {};
  return syscall(SYS_io_uring_setup, 8, parameters) >= 0 || shmget(IPC_PRIVATE, 4096, 0600) >= 0 ||
         syscall(SYS_msgget, IPC_PRIVATE, 0600) >= 0 || syscall(SYS_semget, IPC_PRIVATE, 1, 0600) >= 0 ||
         syscall(SYS_add_key, "user", "dmrp", "x", 1, -4) >= 0 || syscall(SYS_userfaultfd, UFFD_USER_MODE_ONLY) >= 0 ||
         memfd_create("dmrp", 0) >= 0;
}

// Of the priority of a process that is none of the guest's own two.
inline bool slows_others_down() {
  constexpr int first_other = 3;
  constexpr int most = 100'000;
  for (int process = first_other; process < most; ++process)
    if (setpriority(PRIO_PROCESS, static_cast<id_t>(process), 19) == 0) return true;
  setpriority(PRIO_PGRP, 0, 19);
  setpriority(PRIO_USER, getuid(), 19);
  return false;
}

// A network has hosts that refuse a connection; here there is none.
inline bool reaches_a_network() {
  const int number = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in local{};
  local.sin_family = AF_INET;
  local.sin_port = htons(1);
  local.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return connect(number, reinterpret_cast<const sockaddr*>(&local), sizeof(local)) == 0 || errno != ENETUNREACH;
}

// The folder of a test's files, where they can be seen.
inline std::filesystem::path outside_folder() {
  const char* const outside = std::getenv("DMRP_TEST_OUTSIDE");
  return outside ? std::filesystem::path(outside).parent_path() : "/none";
}

inline bool reads_elsewhere() {
  return std::filesystem::exists(outside_folder()) || std::filesystem::exists("/home") ||
         std::filesystem::exists("/etc/passwd") || std::filesystem::exists("/proc/1");
}

// All that results lie in.
inline void falsify_databases() {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(outside_folder(), ignored))
    if (entry.path().filename().string().rfind("results.sqlite", 0) == 0)
      std::ofstream(entry.path(), std::ios::in | std::ios::ate) << "falsified";
}

inline bool fills_the_disk() {
  constexpr std::size_t size = 256u << 20;
  std::ofstream file(std::filesystem::temp_directory_path() / "much", std::ios::binary);
  file << std::string(size, 'x') << std::flush;
  return file.good();
}

// The guests' folder is that of temporary files; the worker's is above it, and the run directory two levels above that.
inline std::filesystem::path worker_folder() {
  const std::filesystem::path folder = std::filesystem::temp_directory_path().parent_path();
  // nothing else is deleted, whatever the host says
  return folder.parent_path().filename() == "scratch" ? folder : "/none/scratch/none";
}

inline void delete_files(const std::string& of) {
  const std::filesystem::path scratch = worker_folder();
  std::error_code ignored;
  std::filesystem::remove_all(of == "run" ? scratch.parent_path().parent_path() / "traces" : scratch, ignored);
}

inline void write_elsewhere() {
  if (const char* const outside = std::getenv("DMRP_TEST_OUTSIDE")) std::ofstream(outside) << "written by a plugin";
}

inline void replace_trace() {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(worker_folder(), ignored)) {
    const std::filesystem::path trace = entry.path();
    std::filesystem::remove(trace);
    mkfifo(trace.c_str(), 0600);
  }
}

// A pipe or a link under each name that the host will use in the scratch folders and for plans.
inline void plant(const std::string& what) {
  namespace fs = std::filesystem;
  const fs::path scratch = worker_folder().parent_path();
  std::vector<fs::path> places;
  if (!fs::exists(scratch)) return;
  for (const auto& entry : fs::directory_iterator(scratch)) {
    for (const char* const name : {"plan.csv", "samples"}) places.push_back(entry.path() / name);
    for (int trial = 0; trial < 10; ++trial)
      places.push_back(entry.path() / ("trial_00000" + std::to_string(trial) + ".mcap"));
  }
  for (const char* const ending : {".csv", ".json"})
    if (what == "pipes")
      places.push_back(scratch.parent_path() /
                       ("plans/scenario_00_planner_00_repetition_000001" + std::string(ending)));
  std::error_code ignored;
  for (const fs::path& place : places)
    if (what == "pipes")
      mkfifo(place.c_str(), 0600);
    else if (const char* const outside = std::getenv("DMRP_TEST_OUTSIDE"))
      fs::create_symlink(outside, place, ignored);
}

inline void limit(int resource, rlim_t most) {
  const rlimit both = {most, most};
  setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

// As plugins may: of its own, and of OpenMP.
inline void use_threads() {
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back([] { std::this_thread::yield(); });
  for (std::thread& thread : threads) thread.join();
#ifdef _OPENMP
  int sum = 0;
#pragma omp parallel for num_threads(4) reduction(+ : sum)
  for (int i = 0; i < 1000; ++i) sum += i;
  if (sum != 499500) std::abort();
#endif
}

// 200 MB, in memory that no limit on data counts, held until somebody has noticed it.
inline void fill_memory() {
  constexpr std::size_t size = 200u << 20;
  void* const shared = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared != MAP_FAILED) std::memset(shared, 1, size);
  std::this_thread::sleep_for(std::chrono::seconds(4));
}

// 80 MB each in this process and in one that it starts.
inline void fill_memory_of_two() {
  constexpr std::size_t size = 80u << 20;
  fork();
  void* const own = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (own != MAP_FAILED) std::memset(own, 1, size);
  std::this_thread::sleep_for(std::chrono::seconds(4));
}

// What is given out next from the free memory of some sizes is no memory. Nothing happens until somebody asks for it.
inline void corrupt_heap() {
  for (const std::size_t size : {24, 40, 56, 72, 88, 104, 120}) {
    void* const first = std::malloc(size);
    void* const second = std::malloc(size);
    volatile std::uintptr_t place = reinterpret_cast<std::uintptr_t>(second);  // compilers would warn
    std::free(first);
    std::free(second);
    std::memset(reinterpret_cast<void*>(place), 0xff, 16);
  }
}

inline void crash() {
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
}

inline void attack(const std::string& what) {
  if (what == "fork and return") fork();
  if (what == "fork and stay" && fork() == 0)
    for (;;) pause();
  if (what == "clone and return") syscall(SYS_clone, SIGCHLD, nullptr, nullptr, nullptr, nullptr);
  if (what == "forged end")
    write_to_pipes("{\"type\":\"done\",\"outcome\":\"succeeded\",\"repeatable\":true,\"sim_time_s\":1.0}\n");
  if (what == "forged error")
    write_to_pipes("{\"type\":\"error\",\"text\":\"forged\",\"machine\":true,\"number\":28}\n");
  if (what == "no message") write_to_pipes("hello\n");
  if (what == "oversized message") write_to_pipes(std::string(8u << 20, 'x'));
  if (what == "quiet heap corruption") corrupt_heap();
  if (what == "closed channel") close_those("pipe:");
  if (what == "closed trace") close_those(".mcap");
  if (what == "deletes its files") delete_files("worker");
  if (what == "deletes traces") delete_files("run");
  if (what == "replaces its trace") replace_trace();
  if (what == "writes elsewhere") write_elsewhere();
  if (what == "reaches a network" && reaches_a_network()) crash();
  if (what == "reads elsewhere" && reads_elsewhere()) crash();
  if (what == "falsifies databases") falsify_databases();
  if (what == "fills the disk" && fills_the_disk()) crash();
  if (what == "slows others down" && slows_others_down()) crash();
  // only where it should be harmless: outside of a namespace this is the whole machine
  if (what == "kills everything" && getppid() == 0) kill(-1, SIGKILL);
  if (what == "kills its group" && getppid() == 0) kill(0, SIGKILL);
  if (what == "burns processors")
    for (int i = 0; i < 4; ++i)
      std::thread([] {
        for (volatile bool forever = true; forever;) {
        }
      }).detach();
  if (what == "burns processors")
    for (;;) pause();
  if (what == "all closed") close_range(3, ~0u, 0);
  if (what == "all descriptors taken")
    while (dup(2) >= 0) {
    }
  if (what == "files limited") limit(RLIMIT_FSIZE, 4096);
  if (what == "kills itself") std::raise(SIGKILL);
  if (what == "kills siblings")
    for (const int process : siblings()) kill(process, SIGKILL);
  if (what == "looks into others" && sees_others()) crash();
  if (what == "sends signals by a file" && owns_for_parent()) crash();
  if (what == "types into the terminal" && types()) crash();
  if (what == "asks for rings and segments" && has_rings_or_segments()) crash();
  if (what == "plants pipes") plant("pipes");
  if (what == "plants links") plant("links");
  if (what == "runs a program") [[maybe_unused]]
    const int status = std::system("true");
  if (what == "replaces itself") execl("/bin/true", "true", nullptr);
  if (what == "stops its parent") kill(getppid(), SIGSTOP);
  if (what == "ends its parent") kill(getppid(), SIGTERM);
  if (what == "outlives its parent") prctl(PR_SET_PDEATHSIG, 0);
  if (what == "lets others look in") prctl(PR_SET_DUMPABLE, 1);
  if (what == "traces its parent") ptrace(PTRACE_ATTACH, getppid(), nullptr, nullptr);
  if (what == "prints much")
    for (int i = 0; i < 10'000; ++i) std::fprintf(stderr, "%s\n", std::string(4096, 'x').c_str());
  if (what == "threads") use_threads();
  if (what == "reserves")
    mmap(nullptr, std::size_t{1} << 36, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (what == "fills") fill_memory();
  if (what == "two fill") fill_memory_of_two();
  if (what == "umask") umask(0777);
  if (what == "traps numbers") feenableexcept(FE_DIVBYZERO | FE_INVALID);
  if (what == "late thread")
    std::thread([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      crash();
    }).detach();
}

}  // namespace dmrp::test
