// SPDX-License-Identifier: MIT
#include "core/trace/trace_schema.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <typeindex>

#include "core/trace/trace_layout.hpp"

namespace dmrp::core {
namespace {

using Names = std::map<std::type_index, std::string>;

// Lists the fields of one struct.
class FieldLister {
 public:
  explicit FieldLister(const Names& types) : types_(types) {}

  const std::string& listed() const { return text_; }

  template <class... Values>
  void values(std::string_view names, const Values&...) {
    (add(type<Values>(), next(names)), ...);
  }
  void clock(std::string_view names, std::int64_t) { add("clock", next(names)); }
  void text(std::string_view names, const auto&) { add("text", next(names)); }
  template <class Value>
  void array(std::string_view names, const Value*, std::uint32_t) {
    add("array " + type<Value>(), next(names));
  }
  template <class Value>
  void array(std::string_view names, std::span<const Value>) {
    add("array " + type<Value>(), next(names));
  }
  template <class Value>
  void optional_array(std::string_view names, const Value*, auto...) {
    std::string product = next(names);
    while (!names.empty()) product += "*" + next(names);
    add("optional " + type<Value>(), product);
  }
  template <class Element>
  void elements(std::string_view names, const Element*, std::uint32_t, std::uint32_t) {
    add("elements " + type<Element>(), next(names));
  }
  template <class Struct>
  void pointer(std::string_view names, const Struct*) {
    add("block " + type<Struct>(), next(names));
  }
  template <class Struct>
  void optional_pointer(std::string_view names, const Struct*) {
    add("optional block " + type<Struct>(), next(names));
  }
  template <class Struct>
  void structs(std::string_view names, const Struct*, std::uint32_t, std::uint32_t) {
    add("blocks " + type<Struct>(), next(names));
  }

 private:
  template <class Type>
  const std::string& type() const {
    return types_.at(typeid(Type));
  }

  // The first of "plan.from_ns, plan.status", here from_ns, which `names` then lacks.
  static std::string next(std::string_view& names) {
    const std::string_view first = names.substr(0, names.find(','));
    names.remove_prefix(std::min(first.size() + 1, names.size()));
    return std::string(first.substr(first.rfind('.') + 1));
  }

  void add(const std::string& type, const std::string& name) {
    text_ += (text_.empty() ? "" : ", ") + type + " " + name;
  }

  const Names& types_;
  std::string text_;
};

class Schema {
 public:
  // A struct that later ones may have.
  template <class Struct>
  void add(const char* name) {
    line<Struct>(name);
    types_[typeid(Struct)] = name;
  }
  template <class Content>
  void add(const char* name, TraceRecordKind kind) {
    line<Content>(name + (" = " + std::to_string(static_cast<int>(kind))));
  }

  const std::string& text() const { return text_; }

 private:
  template <class Struct>
  void line(const std::string& head) {
    FieldLister lister(types_);
    const Struct content{};
    fields(lister, content);
    text_ += head + ": " + lister.listed() + "\n";
  }

  Names types_ = {{typeid(std::uint8_t), "u8"},  {typeid(std::uint32_t), "u32"}, {typeid(std::uint64_t), "u64"},
                  {typeid(std::int32_t), "i32"}, {typeid(std::int64_t), "i64"},  {typeid(float), "f32"},
                  {typeid(double), "f64"}};
  std::string text_;
};

}  // namespace

std::string trace_schema() {
  Schema schema;
  schema.add<dmrp_vec2>("vec2");
  schema.add<dmrp_pose>("pose");
  schema.add<dmrp_twist>("twist");
  schema.add<dmrp_segment>("segment");
  schema.add<dmrp_goal>("goal");
  schema.add<dmrp_waypoint>("waypoint");
  schema.add<dmrp_robot_sample>("robot_sample");
  schema.add<dmrp_person>("person");
  schema.add<dmrp_contact>("contact");
  schema.add<dmrp_call>("call");
  schema.add<dmrp_robot_event>("robot_event");
  schema.add<dmrp_robot_end>("robot_end");
  schema.add<AnnotationSource>("source");
  schema.add<dmrp_limits>("limits");
  schema.add<dmrp_polygon>("polygon");
  schema.add<dmrp_footprint>("footprint");
  schema.add<dmrp_robot>("robot");
  schema.add<dmrp_shape>("shape");
  schema.add<dmrp_grid>("grid");
  schema.add<dmrp_path>("path");
  schema.add<TraceRoute>("route");
  schema.add<dmrp_statistic>("statistic");
  schema.add<TraceWorld>("world", TraceRecordKind::world);
  schema.add<TracePlan>("plan", TraceRecordKind::plan);
  schema.add<TraceSample>("sample", TraceRecordKind::sample);
  schema.add<TraceTrajectory>("trajectory", TraceRecordKind::trajectory);
  schema.add<TraceNote>("note", TraceRecordKind::note);
  schema.add<TraceEnd>("end", TraceRecordKind::end);
  schema.add<TraceScan>("scan", TraceRecordKind::scan);
  return schema.text();
}

}  // namespace dmrp::core
