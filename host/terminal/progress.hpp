// SPDX-License-Identifier: MIT
// progress.hpp: the progress of a run: a bar with the remaining time on a terminal, plain lines elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace dmrp::host {

class Progress {
 public:
  // Writes to standard output, from begin() on; what is to be shown before waits for it.
  Progress(std::uint64_t total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `heading`: what the run is; a line of its own where the bar has no room beside it.
  void begin(std::string heading);
  bool has_begun() const { return begun_; }

  // Counts a finished trial. `text`: for note(), or "". `at`: where the run is, shown behind the times; or "".
  void add(const std::string& text, const std::string& at);

  // Prints a line above the bar.
  void note(const std::string& line);

  // Redraws the bar, at most five times a second.
  void refresh();

  // Draws the bar for the last time.
  void finish();

 private:
  void draw() const;
  void show(const std::string& text);
  double elapsed_s() const;

  std::string heading_;  // beside the bar
  std::string at_;
  std::uint64_t total_;
  std::uint64_t done_ = 0;
  bool quiet_;
  bool terminal_;
  bool begun_ = false;
  std::string waiting_;  // for begin()
  std::int64_t start_ns_;
  std::int64_t drawn_ns_ = 0;  // 0: not drawn, or finished
};

// Whether the heading and the longest bar fit into one line of `width` columns.
bool has_room_beside_bar(const std::string& heading, std::uint64_t total, std::size_t width);

// The bar with its count and times, behind the heading if there is room, of at most `width` columns: a narrow terminal
// gets no heading, then no bar. `at` stands behind the times, if there is room.
std::string progress_line(const std::string& heading, std::uint64_t done, std::uint64_t total, double elapsed_s,
                          std::size_t width, const std::string& at = "");

// Columns of the terminal at standard output; 0 if it is no terminal.
unsigned terminal_width();

}  // namespace dmrp::host
