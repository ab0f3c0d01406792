// SPDX-License-Identifier: MIT
#include "core/trace/trace_schema.hpp"

#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>

#include "core/trace/trace_layout.hpp"

namespace trace_schema_test {

using namespace dmrp::core;

// Where the fields of a struct are, if each begins where the one before ends.
class Places {
 public:
  explicit Places(const void* begin) : place_(static_cast<const std::byte*>(begin)) {}

  const std::byte* end() const { return place_; }

  template <class... Values>
  void values(const char*, const Values&... values) {
    (add(values), ...);
  }
  void clock(const char*, const std::int64_t& value) { add(value); }

 private:
  template <class Value>
  void add(const Value& value) {
    CHECK(reinterpret_cast<const std::byte*>(&value) == place_);
    place_ += sizeof(Value);
  }

  const std::byte* place_;
};

TEMPLATE_TEST_CASE("what is stored as in memory has all its fields in the list, in their order", "[trace]", dmrp_vec2,
                   dmrp_pose, dmrp_twist, dmrp_segment, dmrp_goal, dmrp_waypoint, dmrp_robot_sample, dmrp_person,
                   dmrp_contact, dmrp_call, dmrp_robot_event, dmrp_robot_end, AnnotationSource) {
  const TestType value{};
  Places places(&value);
  fields(places, value);
  CHECK(places.end() == reinterpret_cast<const std::byte*>(&value + 1));
}

TEST_CASE("the schema has a field's type and name, and marks what clocks measure", "[trace]") {
  const std::string schema = trace_schema();
  for (const char* line : {
           "\ncall: u32 kind, u32 robot, i32 status, u32 reserved, clock duration_ns\n",
           "\nfootprint: f64 radius_m, f64 inscribed_radius_m, blocks polygon parts\n",
           " optional u8 edges*width*height, optional f32 clearance*width*height\n",
           " array segment segments, optional block grid planning_grid\n",
           "\nend = 6: u32 ending, i64 t_ns, elements robot_end robots, text reason\n",
       })
    CHECK_THAT(schema, Catch::Contains(line));
}

}  // namespace trace_schema_test
