// SPDX-License-Identifier: MIT
// progress.hpp: how far a run is: a bar with the time to go on a terminal, plain lines elsewhere.
#pragma once

#include <cstdint>
#include <string>

namespace dmrp::host {

class Progress {
 public:
  // `heading`: what is being run. Writes to standard output.
  Progress(std::string heading, std::uint64_t total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // One more trial is done. `note`: a line worth keeping, or "".
  void add(const std::string& note);

  // Draws the bar again, at most a few times a second.
  void refresh();

  // Draws it for the last time.
  void finish();

 private:
  void draw() const;
  double elapsed_s() const;

  std::string heading_;
  std::uint64_t total_;
  std::uint64_t done_ = 0;
  bool quiet_;
  bool terminal_;
  std::int64_t start_ns_;
  std::int64_t drawn_ns_ = 0;  // 0: not, or it is finished
};

// Columns of the terminal behind standard output; 0 if it is none.
unsigned terminal_width();

}  // namespace dmrp::host
