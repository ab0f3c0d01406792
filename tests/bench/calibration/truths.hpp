// SPDX-License-Identifier: MIT
// truths.hpp: benchmarks drawn from what is known to be true, to measure how often statistics are right about it.
#pragma once

#include <cstddef>
#include <dmrp/toolkit/random.hpp>
#include <vector>

namespace dmrp::bench {

using Values = std::vector<std::vector<double>>;  // [entry][task]

// Times over the lengths of shortest ways: a task slows all entries alike, one time in ten has a long tail, and the last
// entry is slower by `slower`, a share of the time without that.
Values drawn_times(toolkit::Stream& random, std::size_t entries, std::size_t tasks, double slower = 0.0);

// Shares of five robots that arrive safely, in nine of ten cases or so: tasks differ in difficulty, for an entry too. Each
// robot of the last entry fails with a probability of `worse` on top.
Values drawn_shares(toolkit::Stream& random, std::size_t entries, std::size_t tasks, double worse = 0.0);

// Times of tasks as means over crowd seeds, with an effect of the task on the entry that all seeds share.
Values drawn_times_by_seeds(toolkit::Stream& random, std::size_t entries, std::size_t tasks, std::size_t seeds);

// Times of the tasks of worlds (one after another), with an effect of the world on the entry.
Values drawn_times_in_worlds(toolkit::Stream& random, std::size_t entries, std::size_t worlds, std::size_t tasks);

// Seconds that people lose, of either sign.
Values drawn_delays(toolkit::Stream& random, std::size_t entries, std::size_t tasks);

// Two metrics of entries that have nothing to do with each other, but of each metric the entries' values on a task agree:
// `agreement` of their variance is the task's.
Values drawn_normals(toolkit::Stream& random, std::size_t entries, std::size_t tasks, double agreement);

}  // namespace dmrp::bench
