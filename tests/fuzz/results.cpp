// SPDX-License-Identifier: MIT
// Databases of results, as reports and merge read them.
#include "host/errors/machine_error.hpp"
#include "host/results/database.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dmrp;
  static const test::ExperimentFolder folder;
  fuzz::write_file("results.sqlite", fuzz::text(data, size));
  try {
    const auto database = host::ResultsDatabase::open_read_only("results.sqlite");
    database.metrics();
    database.finished_trials();
    database.trials();
  } catch (const host::SqliteError&) {
  } catch (const host::MachineError&) {  // SQLite takes some damage for a failed disk
  }
  return 0;
}
