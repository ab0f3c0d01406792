// SPDX-License-Identifier: MIT
#include "host/guests/python_guest.hpp"

#include <signal.h>
#include <unistd.h>

#include <cstdlib>

#include "host/plugins/python_file.hpp"
#include "host/process/box.hpp"
#include "host/process/environment.hpp"

namespace dmrp::host {

void become_python(const GuestOrder& order) {
  const std::string python = python_interpreter().string();
  if (box::kind() != "none") reduce_environment(order.arguments.at(2));  // before Python copies it
  const char* const known = std::getenv("PYTHONPATH");
  const std::string path = python_guest_path().string() + (known ? ":" + std::string(known) : "");
  setenv("PYTHONPATH", path.c_str(), 1);
  setenv("PYTHONHASHSEED", "0", 1);  // sets of texts have one order
  setenv("PYTHONSAFEPATH", "1", 1);
  setenv("PYTHONNOUSERSITE", "1", 1);
  setenv("PYTHONUTF8", "1", 1);
  setenv("PYTHONUNBUFFERED", "1", 1);  // what a guest has printed is read after its end
  // a product of matrices depends on the number of threads
  for (const char* const threads : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"})
    setenv(threads, "1", 0);
  signal(SIGINT, SIG_IGN);  // Python would raise an exception
  std::vector<std::string> words = {python, "-B", "-m", "dmrp.guest", std::to_string(order.descriptors.size())};
  words.insert(words.end(), order.arguments.begin(), order.arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(python.c_str(), pointers.data());
}

}  // namespace dmrp::host
