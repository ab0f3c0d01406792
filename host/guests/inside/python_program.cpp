// SPDX-License-Identifier: MIT
// libdmrp_guest.so, which python3 loads: the guest's program, for a Python file.
#include <unistd.h>

#include "host/guests/inside/guest_program.hpp"
#include "host/plugins/python_file.hpp"

extern "C" __attribute__((visibility("default"))) int dmrp_run_guest(const dmrp::host::PythonFunctions* functions,
                                                                     int descriptor_count, const char** arguments,
                                                                     int argument_count) {
  dmrp::host::python_functions() = functions;
  std::vector<int> descriptors;
  for (int i = 0; i < descriptor_count; ++i) descriptors.push_back(STDERR_FILENO + 1 + i);
  return dmrp::host::run_guest({arguments, arguments + argument_count}, descriptors);
}
