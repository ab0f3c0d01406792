// SPDX-License-Identifier: MIT
#include "host/process/one_processor.hpp"

#include <vector>

namespace dmrp::host {

// Where it fails, the process is slower.
OneProcessor::OneProcessor(unsigned wanted) {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof(allowed), &allowed);
  std::vector<unsigned> numbers;
  std::size_t first = 0;
  for (unsigned i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &allowed)) numbers.push_back(i);
  if (numbers.empty()) return;
  while (first < numbers.size() && numbers[first] < wanted % (numbers.back() + 1)) ++first;
  CPU_ZERO(&own_);
  CPU_SET(numbers[first], &own_);
  add(0);
}

void OneProcessor::add(pid_t process) const {
  sched_setaffinity(process, sizeof(own_), &own_);
}

}  // namespace dmrp::host
