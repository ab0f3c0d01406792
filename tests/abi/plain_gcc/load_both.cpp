// SPDX-License-Identifier: MIT
// load_both LIBRARY_1 LIBRARY_2: loads both as a host does; each must describe and drive as its own source says.
#include <dlfcn.h>
#include <dmrp/dmrp.h>

#include <cstdio>
#include <string>

namespace {

int failures = 0;

void expect(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "FAILED: %s\n", what.c_str());
  ++failures;
}

const dmrp_entry* load(const char* path) {
  void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (!library) std::fprintf(stderr, "%s\n", dlerror());
  return library ? static_cast<const dmrp_entry*>(dlsym(library, DMRP_ENTRY_SYMBOL)) : nullptr;
}

dmrp_host make_host() {
  dmrp_host host{};
  host.struct_size = sizeof(host);
  host.set_error = [](const dmrp_host*, const char* text) { std::fprintf(stderr, "%s\n", text); };
  return host;
}

// What is particular to the library that was built with this number.
void check(const dmrp_entry& entry, int number) {
  const std::string suffix = "_" + std::to_string(number);
  const dmrp_descriptor& descriptor = *entry.descriptor(&entry, 0);
  const std::string id = descriptor.id;
  expect(id == "org.example.follower" + suffix, "library " + std::to_string(number) + " has the plugin " + id);
  const dmrp_param_spec& spec = *descriptor.params;
  expect(spec.key == "speed" + suffix, "its parameter is " + std::string(spec.key));
  expect(spec.number == 1.0 * number, "its default is " + std::to_string(spec.number));

  const dmrp_host host = make_host();
  dmrp_param_value value{};
  value.key = spec.key;
  value.type = DMRP_PARAM_DOUBLE;
  value.number = 10.0 * number;
  const dmrp_params params = {sizeof(params), 1, sizeof(value), 0, &value};
  dmrp_plugin plugin{};
  plugin.struct_size = sizeof(plugin);
  expect(entry.create(&entry, &host, ("org.example.follower" + suffix).c_str(), &params, &plugin) == DMRP_OK, "create");
  if (!plugin.self) return;

  const dmrp_world world{};
  const dmrp_start start = {sizeof(start), 0, 1, &world};
  expect(plugin.start(plugin.self, &start) == DMRP_OK, "start");
  dmrp_observation observation{};
  const dmrp_limits limits{};
  const dmrp_footprint footprint{};
  const dmrp_goal goal{};
  observation.struct_size = sizeof(observation);
  observation.goal = &goal;
  observation.limits = &limits;
  observation.footprint = &footprint;
  dmrp_command command{};
  command.struct_size = sizeof(command);
  const auto& controller = *static_cast<const dmrp_local_controller*>(plugin.table);
  expect(controller.step(plugin.self, &observation, &command) == DMRP_OK, "step");
  expect(command.v_x == 10.0 * number && command.omega == -1.0 * number,
         "library " + std::to_string(number) + " commands " + std::to_string(command.v_x) + ", " +
             std::to_string(command.omega));
  plugin.destroy(plugin.self);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const dmrp_entry* first = load(argv[1]);
  const dmrp_entry* second = load(argv[2]);
  expect(first && second, "both load");
  if (!first || !second) return 1;
  check(*first, 1);
  check(*second, 2);
  check(*first, 1);
  return failures == 0 ? 0 : 1;
}
