// SPDX-License-Identifier: MIT
// The progress bar keeps its heading at every width, and no line of it wraps.
#include "host/terminal/progress.hpp"

#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "host/terminal/colors.hpp"
#include "host/terminal/display_width.hpp"

namespace {

using dmrp::host::Progress;

// Standard output is a terminal of so many columns as long as this lives.
class Terminal {
 public:
  explicit Terminal(unsigned short columns) : before_(dup(STDOUT_FILENO)) {
    winsize size{};
    size.ws_col = columns;
    size.ws_row = 24;
    int slave = -1;
    if (openpty(&master_, &slave, nullptr, nullptr, &size) != 0) return;
    fcntl(master_, F_SETFL, O_NONBLOCK);
    dup2(slave, STDOUT_FILENO);
    close(slave);
    setenv("TERM", "xterm", 1);
  }
  ~Terminal() {
    dup2(before_, STDOUT_FILENO);
    close(before_);
    if (master_ >= 0) close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  bool is_open() const { return master_ >= 0; }

  std::string written() const {
    std::fflush(stdout);
    std::string text(65536, '\0');
    const ssize_t size = read(master_, text.data(), text.size());
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
  }

 private:
  int before_;
  int master_ = -1;
};

// The lines, each as it was drawn last and before.
std::vector<std::string> lines_of(std::string text) {
  std::vector<std::string> lines(1);
  for (const char* erase : {"\x1b[2K", "\r"})
    for (std::size_t at = 0; (at = text.find(erase)) != std::string::npos;)
      text.replace(at, std::string(erase).size(), "\n");
  for (const char c : text)
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  std::erase(lines, "");
  return lines;
}

}  // namespace

TEST_CASE("the progress bar keeps its heading and does not wrap") {
  const std::string heading = "quickstart · mall · 4 robots, 12 people · 3 trials";
  for (const unsigned short columns : {40, 80, 120, 200}) {
    std::string text;
    {
      const Terminal terminal(columns);
      if (!terminal.is_open()) return;  // no pseudoterminals here
      Progress progress(heading, 3, false);
      for (int i = 0; i < 3; ++i) progress.add("");
      progress.finish();
      text = terminal.written();
    }
    INFO(columns << ": " << text);
    CHECK(text.find(heading) != std::string::npos);
    CHECK(text.find("3/3") != std::string::npos);
    for (const std::string& line : lines_of(text))
      if (line != heading) CHECK(dmrp::host::display_width(line) < columns);
    CHECK(lines_of(text).front().starts_with(heading));
  }
}

TEST_CASE("a terminal has colours unless NO_COLOR is set or it is dumb") {
  const Terminal terminal(80);
  if (!terminal.is_open()) return;
  unsetenv("NO_COLOR");
  const bool plain = dmrp::host::has_colors(STDOUT_FILENO);
  setenv("NO_COLOR", "1", 1);
  const bool refused = dmrp::host::has_colors(STDOUT_FILENO);
  unsetenv("NO_COLOR");
  setenv("TERM", "dumb", 1);
  const bool dumb = dmrp::host::has_colors(STDOUT_FILENO);
  setenv("TERM", "xterm", 1);
  CHECK(plain);
  CHECK_FALSE(refused);
  CHECK_FALSE(dumb);
}
