// SPDX-License-Identifier: MIT
// Blame for contacts: the three measures against a hundred scenes that were judged by hand (contact_scenes.txt).
#include <algorithm>
#include <catch2/catch.hpp>
#include <dmrp/toolkit/random.hpp>
#include <fstream>
#include <iterator>
#include <map>

#include "tests/support/draws.hpp"
#include "tests/unit/metrics/safety/contact_scene.hpp"

namespace contact_scenes_test {

using namespace dmrp::test;
using dmrp::toolkit::Stream;

const std::vector<ContactScene>& scenes() {
  static const std::vector<ContactScene> read = read_contact_scenes(DMRP_CONTACT_SCENES);
  return read;
}

const std::string& outcome_of(const ContactScene& scene) {
  static std::map<std::size_t, std::string> judged;
  std::string& verdict = judged[scene.line];
  if (verdict.empty()) verdict = judge(scene);
  return verdict;
}

// Scenes of a kind and a set, and in how many of them each measure agrees.
struct Agreement {
  int scenes = 0;
  std::array<int, 3> agree{};

  void add(const std::string& expected, const std::string& found) {
    ++scenes;
    for (std::size_t i = 0; i < agree.size(); ++i) agree[i] += expected[i] == found[i] ? 1 : 0;
  }
  std::string text() const {
    std::string cells = " " + std::to_string(scenes) + " |";
    for (const int count : agree) cells += " " + std::to_string(count) + " |";
    return cells;
  }
};

std::string agreement_table() {
  std::vector<std::string> kinds;
  std::map<std::string, std::map<std::string, Agreement>> found;
  for (const ContactScene& scene : scenes()) {
    if (found.count(scene.kind) == 0) kinds.push_back(scene.kind);
    found[scene.kind][scene.set].add(scene.verdict, outcome_of(scene));
    found["all"][scene.set].add(scene.verdict, outcome_of(scene));
  }
  kinds.push_back("all");
  std::string table =
      "| kind | seen | without contact | safe | braking | kept apart | without contact | safe | braking |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const std::string& kind : kinds)
    table += "| " + kind + " |" + found[kind]["fit"].text() + found[kind]["held"].text() + "\n";
  return table;
}

std::string sensitivity_table() {
  const std::vector<std::pair<std::string, std::vector<double>>> tried = {{"reaction_s", {0.1, 0.2, 0.3, 0.5}},
                                                                          {"braking_share", {0.8, 0.95, 1.0}},
                                                                          {"swerve_s", {0.0, 0.5, 1.0, 2.0}},
                                                                          {"hidden_speed", {0.0, 1.0, 1.5, 2.0}}};
  std::string table = "| parameter | value | agree | excused |\n| --- | --- | --- | --- |\n";
  for (const auto& [name, values] : tried)
    for (const double value : values) {
      int agree = 0, excused = 0;
      for (const ContactScene& scene : scenes()) {
        const std::string verdict = judge(scene, {{name, value}});
        agree += verdict[2] == scene.verdict[2] ? 1 : 0;
        excused += verdict[2] != verdict[1] ? 1 : 0;
      }
      std::ostringstream row;
      row << "| `" << name << "` | " << value << " | " << agree << " | " << excused << " |\n";
      table += row.str();
    }
  return table;
}

bool page_has(const std::string& table) {
  std::ifstream file(DMRP_CONTACTS_PAGE);
  const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return page.find(table) != std::string::npos;
}

// A robot among walls that drives somehow, and a person who walks somehow, or another robot.
ContactScene random_scene(std::uint64_t seed) {
  Stream stream(seed, "test.contact_scenes");
  const auto drive = [&](SceneRobot& robot) {
    for (double t_s = 0.0; t_s < 8.0; t_s += 0.5)
      robot.commands.push_back({t_s, stream.uniform(0.0, 1.0) < 0.3 ? 0.0 : 0.8, stream.uniform(-0.5, 0.5)});
  };
  const auto place = [&] {
    return detail::scene_origin + dmrp_vec2{stream.uniform(-3.0, 3.0), stream.uniform(-3.0, 3.0)};
  };
  ContactScene scene;
  scene.robot.start = {detail::scene_origin.x, detail::scene_origin.y, stream.uniform(-3.0, 3.0)};
  drive(scene.robot);
  if (seed % 3 == 0) {
    const dmrp_vec2 start = place();
    scene.other = SceneRobot{"", {start.x, start.y, stream.uniform(-3.0, 3.0)}, {}};
    drive(*scene.other);
  } else {
    for (std::int64_t k = 0; k < 6; ++k) scene.person.points.push_back({k * 1'500'000'000, place()});
  }
  if (seed % 2 == 0) scene.walls = {{1.0, 1.0, 2.0, 3.0}, {-2.0, -4.0, -1.0, -0.8}};
  return scene;
}

TEST_CASE("a hundred scenes, half of them kept apart, five of each kind") {
  std::map<std::string, int> count;
  for (const ContactScene& scene : scenes()) ++count[scene.kind + " " + scene.set];
  CHECK(scenes().size() == 100);
  for (const auto& [name, scenes_of_it] : count) CHECK((name + " " + std::to_string(scenes_of_it)) == name + " 5");
}

TEST_CASE("the measures judge the scenes as the text of the rule does") {
  for (const ContactScene& scene : scenes()) {
    INFO("line " << scene.line << ": " << scene.reason);
    CHECK(outcome_of(scene) == scene.verdict);
  }
}

TEST_CASE("docs/measured/contacts.md has the agreement and the sensitivity of today") {
  for (const std::string& table : {agreement_table(), sensitivity_table()}) {
    INFO("should have\n" << table);
    CHECK(page_has(table));
  }
}

TEST_CASE("a robot without contact is safe, and a safe robot needs no excuse") {
  int contacts = 0, excused = 0;
  for (std::uint64_t seed = 1; seed <= draws(150u); ++seed) {
    const SyntheticTrial trial = trial_of(random_scene(seed), TrialLength::whole);
    const Measurement success = measure("dmrp.metric.success", trial);
    const Measurement braking = measure("dmrp.metric.braking_response", trial);
    for (std::size_t robot = 0; robot < trial.robot_count(); ++robot) {
      INFO("seed " << seed << ", robot " << robot);
      const double contact_free = success.robot("contact_free_success", robot);
      const double safe = success.robot("safe_success", robot);
      CHECK(contact_free <= safe);
      CHECK(safe <= braking.robot("braking_response_success", robot));
      contacts += contact_free == 0.0 ? 1 : 0;
      excused += safe == 1.0 && contact_free == 0.0 ? 1 : 0;
    }
  }
  CHECK(contacts > 0);
  CHECK(excused > 0);
}

}  // namespace contact_scenes_test
