// SPDX-License-Identifier: MIT
#include "host/report/report_page.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "host/errors/input_error.hpp"
#include "host/report/replay/page_packing.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace report_page_test {

using namespace dmrp::host;

TEST_CASE("the page contains its parts, and no part ends another", "[report]") {
  dmrp::test::ScratchFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) { std::ofstream(folder / name) << text; };
  write("page.html", "<!-- dmrp:styles -->|<!-- dmrp:data -->|<!-- dmrp:scripts -->");
  write("page.css", "s");
  write("page.js", "'</script>'");
  write("three.min.js", "three");
  const std::string styles = "<style>\ns</style>\n|";
  const std::string data = "<script type=\"application/json\" id=\"dmrp-data\">{\"x\":\"\\u003c/script>\"}</script>\n";
  const std::string scripts = "|<script>\n'<\\/script>'</script>\n";
  CHECK(report_page(folder.path(), "page", R"({"x":"</script>"})", {}) == styles + data + scripts);
  const std::vector<EmbeddedReplay> replays{{"dmrp-replay-3", "QUJD"}};
  CHECK(report_page(folder.path(), "page", R"({"x":"</script>"})", replays) ==
        styles + data + "<script type=\"application/gzip\" id=\"dmrp-replay-3\">QUJD</script>\n" +
            "<script type=\"application/gzip\" id=\"dmrp-three\">" + base64(gzip("three")) + "</script>\n" + scripts);
  write("page.html", "<!-- dmrp:styles -->|<!-- dmrp:scripts -->");
  CHECK_THROWS_WITH(report_page(folder.path(), "page", "{}", {}), Catch::Contains("has no line <!-- dmrp:data -->"));
  std::filesystem::remove(folder / "page.js");
  CHECK_THROWS_AS(report_page(folder.path(), "page", "{}", {}), InputError);
}

}  // namespace report_page_test
