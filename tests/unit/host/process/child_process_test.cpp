// SPDX-License-Identifier: MIT
#include "host/process/child_process.hpp"

#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>

#include "host/process/call_note.hpp"
#include "host/process/line_channel.hpp"
#include "host/process/resource_limits.hpp"
#include "host/process/watchdog.hpp"

namespace child_process_test {

using namespace dmrp::host;

// A copy of this process, which runs `function`.
std::unique_ptr<ChildProcess> copy_for(const std::function<void()>& function) {
  const pid_t number = fork();
  if (number != 0) return ChildProcess::adopt(number);
  be_child();
  try {
    function();
  } catch (const std::bad_alloc&) {
    _exit(out_of_memory_exit);
  }
  _exit(0);
}

ProcessEnding ending_of(const std::function<void()>& function) {
  return copy_for(function)->wait();
}

TEST_CASE("the end of a child is explained") {
  const ProcessEnding good = ending_of([] {});
  CHECK(good.succeeded());
  CHECK(good.explain(400) == "ended the process with status 0");
  CHECK(good.peak_rss_mb > 0.0);

  const ProcessEnding exited = ending_of([] { _exit(3); });
  CHECK_FALSE(exited.succeeded());
  CHECK(exited.fault_kind() == std::string(fault_kind::exit));
  CHECK(exited.explain(400) == "ended the process with status 3");

  const ProcessEnding crashed = ending_of([] {
    signal(SIGSEGV, SIG_DFL);  // a sanitizer's handler would exit
    raise(SIGSEGV);
  });
  CHECK_FALSE(crashed.succeeded());
  CHECK(crashed.fault_kind() == std::string(fault_kind::crash));
  CHECK(crashed.explain(400) == "crashed (signal 11, Segmentation fault)");

  const ProcessEnding full = ending_of([] { throw std::bad_alloc(); });
  CHECK(full.fault_kind() == std::string(fault_kind::out_of_memory));
  CHECK(full.explain(400) == "needs more than 400 MB of memory");
  CHECK(full.explain(0) == "found no more memory: the machine has none left");
  // a limit of the shell is smaller than the process's own
  const ProcessEnding limited = ending_of([] {
    const rlimit data = {rlim_t{300} << 20, rlim_t{300} << 20};
    setrlimit(RLIMIT_DATA, &data);
    const bool is_told =
        lack_of_memory(400) == "found no more memory: the shell or job allows a process 300 MB (ulimit -v, -d)" &&
        lack_of_memory(0) == lack_of_memory(400) && lack_of_memory(200) == "needs more than 200 MB of memory";
    _exit(is_told ? 0 : 1);
  });
  CHECK(limited.succeeded());
}

TEST_CASE("a child that takes more processor time than it may is ended") {
  const auto child = copy_for([] {
    for (volatile bool forever = true; forever;) {
    }
  });
  child->allow_cpu(0.1);
  const ProcessEnding& ending = child->wait();
  CHECK(ending.signal == SIGXCPU);
  CHECK(ending.fault_kind() == std::string(fault_kind::hang));
  child->allow_cpu(5.0);  // it has ended: nothing to allow
  CHECK(ending.explain(400) == "took more than 0.1 s of processor time");
}

TEST_CASE("a child that others keep from the processor is known to wait") {
  if (access("/proc/self/schedstat", R_OK) != 0) {
    WARN("skipped: the kernel does not count waiting");
    return;
  }
  const auto spin = [processor = sched_getcpu()] {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(processor), &one);
    sched_setaffinity(0, sizeof(one), &one);
    for (volatile int turns = 0;;) turns = turns + 1;
  };
  const auto one = copy_for(spin);
  const auto other = copy_for(spin);
  while (one->waited_for_processor_ns() < 20'000'000 || other->waited_for_processor_ns() < 20'000'000) usleep(10'000);
}

TEST_CASE("processes share the processors, each has one") {
  CHECK(processor_time_s(2.0, 1) >= 2.0);
  CHECK(processor_time_s(2.0, 1'000'000) == 2.0);
}

TEST_CASE("a child is killed, and waited for once") {
  const auto child = copy_for([] { pause(); });
  child->kill();
  CHECK(child->wait().signal == SIGKILL);
  child->kill();  // not another process that has its number now
  CHECK(child->wait().signal == SIGKILL);
}

TEST_CASE("a child reads nothing and sends messages until it ends") {
  Pipe pipe = make_pipe();
  const auto child = copy_for([&] {
    char byte;
    LineChannel channel(Descriptor(), std::move(pipe.write_end));
    channel.send({{"read", read(STDIN_FILENO, &byte, 1)}});
  });
  pipe.write_end.close();
  LineChannel channel(std::move(pipe.read_end), Descriptor());
  CHECK(channel.receive().value().at("read") == 0);
  CHECK_FALSE(channel.receive());
  CHECK(child->wait().succeeded());
}

TEST_CASE("the parent sees the call that its child has noted") {
  const SharedCallNote note(make_call_note());
  CHECK_FALSE(note.read().inside);
  copy_for([&] {
    note.note().function = {'p', 'l', 'a', 'n'};
    note.note().call_number = 1;
  })->wait();
  CHECK(note.read().inside);
  CHECK(note.read().function == "plan");
}

TEST_CASE("when memory is short, the kernel kills a child before its parent") {
  const auto score = [] {
    int found = 0;
    std::ifstream("/proc/self/oom_score_adj") >> found;
    return found;
  };
  Pipe pipe = make_pipe();
  const auto child = copy_for([&] { LineChannel(Descriptor(), std::move(pipe.write_end)).send({{"score", score()}}); });
  pipe.write_end.close();
  LineChannel channel(std::move(pipe.read_end), Descriptor());
  const int of_child = channel.receive().value().at("score");
  CHECK(of_child == std::min(score() + 500, 1000));
  CHECK((of_child > score() || score() == 1000));
}

TEST_CASE("a watchdog waits for the end of a child, or until it is late") {
  const auto sleeper = copy_for([] { pause(); });
  REQUIRE(sleeper->ended().is_open());
  Watchdog watchdog;
  int asked = 0;
  CHECK_FALSE(watchdog.wait(sleeper->ended().number(), [&] { return ++asked == 2; }));
  CHECK(asked == 2);
  sleeper->kill();
  CHECK(watchdog.wait(sleeper->ended().number(), [] { return false; }));
}

}  // namespace child_process_test
