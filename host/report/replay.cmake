# SPDX-License-Identifier: MIT
# What of a run's traces goes into its report, to be played there.
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(ZLIB REQUIRED)

add_library(
  dmrp_host_replay STATIC
  report/page_packing.cpp
  report/replay_choice.cpp
  report/replay_contacts.cpp
  report/replay_data.cpp
  report/replay_tracks.cpp
  report/replay_world.cpp
  report/replays.cpp)
target_link_libraries(
  dmrp_host_replay
  PUBLIC dmrp_host_results nlohmann_json::nlohmann_json
  PRIVATE fmt::fmt OpenSSL::Crypto ZLIB::ZLIB dmrp_build_settings)
