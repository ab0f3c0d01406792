// SPDX-License-Identifier: MIT
#include "host/terminal/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "host/program/monotonic_time.hpp"
#include "host/terminal/display_width.hpp"

namespace dmrp::host {

namespace {

constexpr unsigned bar_cells = 16;
constexpr std::size_t longest_times = 28;  // "  99.9 s, 999:59 min to go"
constexpr std::int64_t redraw_ns = 200'000'000;

// One that can overwrite a line: not an editor's, which says so.
bool is_terminal() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDOUT_FILENO) && !(kind && std::string_view(kind) == "dumb");
}

std::string duration(double s) {
  if (s < 99.95) return fmt::format("{:.1f} s", s);
  const auto whole = static_cast<long>(s + 0.5);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

constexpr const char* cleared = "\r\x1b[2K";

}  // namespace

unsigned terminal_width() {
  winsize size{};
  if (!is_terminal() || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return 0;
  return size.ws_col;
}

// A line that wraps cannot be overwritten: one column stays free.
std::size_t usable_width() {
  const unsigned columns = terminal_width();  // 0 if unknown
  return (columns > 0 ? columns : 80) - 1;
}

bool has_room_beside_bar(const std::string& heading, std::uint64_t total, std::size_t width) {
  const std::size_t longest_count = 2 * std::to_string(total).size() + 2;
  return display_width(heading) + 2 + bar_cells + longest_count + longest_times <= width;
}

std::string progress_line(const std::string& heading, std::uint64_t done, std::uint64_t total, double elapsed_s,
                          std::size_t width, const std::string& at) {
  const double share = total ? static_cast<double>(done) / static_cast<double>(total) : 1.0;
  const auto full = static_cast<unsigned>(share * bar_cells + 0.5);
  std::string bar;
  for (unsigned i = 0; i < bar_cells; ++i) bar += i < full ? "█" : "░";
  const std::string count = fmt::format("{}/{}", done, total);
  std::string times = "  " + duration(elapsed_s);
  if (done > 0 && done < total)
    times +=
        fmt::format(", {} to go", duration(elapsed_s / static_cast<double>(done) * static_cast<double>(total - done)));
  std::string line = fmt::format("{} {}{}", bar, count, times);
  if (const std::string longer = line + "  " + at; !at.empty() && display_width(heading + longer) + 2 <= width)
    line = longer;
  const std::size_t used = display_width(heading) + display_width(line);
  if (!heading.empty() && used + 2 <= width)
    return heading + std::string(std::min<std::size_t>(width - used, 24), ' ') + line;
  if (display_width(line) <= width) return line;
  return count.size() + times.size() <= width ? count + times : count;
}

Progress::Progress(std::uint64_t total, bool quiet)
    : total_(total), quiet_(quiet), terminal_(is_terminal()), start_ns_(monotonic_ns()) {
  if (quiet_ || !terminal_) return;
  std::fputs("timing the first trials ...", stdout);
  std::fflush(stdout);
}

void Progress::begin(std::string heading) {
  begun_ = true;
  heading_ = std::move(heading);
  if (quiet_) return;
  if (terminal_) show(cleared);
  if (!terminal_ || !has_room_beside_bar(heading_, total_, usable_width())) {
    show(heading_ + "\n");
    heading_.clear();
  }
  show(waiting_);
  std::fflush(stdout);
  refresh();
}

// The run goes on where standard output is closed or full; fmt::print would throw.
void Progress::show(const std::string& text) {
  if (begun_)
    std::fputs(text.c_str(), stdout);
  else
    waiting_ += text;
}

Progress::~Progress() {
  if (!quiet_ && terminal_ && (!begun_ || drawn_ns_ > 0)) std::fputs("\n", stdout);  // before an error message
  std::fflush(stdout);
}

double Progress::elapsed_s() const {
  return static_cast<double>(monotonic_ns() - start_ns_) * 1e-9;
}

void Progress::draw() const {
  std::fputs((cleared + progress_line(heading_, done_, total_, elapsed_s(), usable_width(), at_)).c_str(), stdout);
  std::fflush(stdout);
}

void Progress::refresh() {
  if (quiet_ || !begun_ || !terminal_ || monotonic_ns() - drawn_ns_ < redraw_ns) return;
  draw();
  drawn_ns_ = monotonic_ns();
}

void Progress::note(const std::string& line) {
  if (!quiet_) show((terminal_ ? cleared : "  ") + line + "\n");
}

void Progress::add(const std::string& text, const std::string& at) {
  ++done_;
  at_ = done_ < total_ ? at : "";
  if (quiet_) return;
  if (!text.empty()) note(text);
  if (terminal_) return begun_ ? draw() : void();
  show(fmt::format("  {}/{}  {}{}{}\n", done_, total_, duration(elapsed_s()), at.empty() ? "" : "  ", at));
  std::fflush(stdout);
}

void Progress::finish() {
  if (quiet_ || !terminal_) return;
  draw();
  show("\n");
  drawn_ns_ = 0;
}

}  // namespace dmrp::host
