// SPDX-License-Identifier: MIT
#include "host/results/sqlite.hpp"

#include <catch2/catch.hpp>

#include "host/errors/machine_error.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace sqlite_test {

using namespace dmrp::host;

TEST_CASE("a full database is a failure of the machine, a mistake in SQL is not", "[results]") {
  const dmrp::test::ScratchFolder folder;
  SqliteConnection connection(folder / "full.sqlite", SqliteMode::create);
  connection.execute("CREATE TABLE filler (content)");
  connection.execute("PRAGMA max_page_count = 2");
  const std::string fill = "INSERT INTO filler VALUES (randomblob(100000))";
  CHECK_THROWS_AS(connection.execute(fill), MachineError);
  CHECK_THROWS_WITH(connection.execute(fill), Catch::Contains("full.sqlite") && Catch::Contains("full"));
  CHECK_THROWS_AS(SqliteStatement(connection, fill).run(), MachineError);
  CHECK_THROWS_AS(connection.execute("INSERT INTO nothing VALUES (1)"), SqliteError);
}

}  // namespace sqlite_test
