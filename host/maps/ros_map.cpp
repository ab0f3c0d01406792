// SPDX-License-Identifier: MIT
// The format: http://wiki.ros.org/map_server and nav2_map_server's map_io.
#include "host/maps/ros_map.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "host/errors/input_error.hpp"
#include "host/files/read_file.hpp"
#include "host/maps/map_image.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

namespace {

constexpr std::uintmax_t max_yaml_bytes = 1 << 16;
constexpr double min_resolution_m = 0.001;
constexpr double max_resolution_m = 100.0;
constexpr double max_origin_m = 1e6;
constexpr int max_free_probability = 49;  // of 100

enum class Mode { trinary, scale, raw };

struct Shades {
  Mode mode = Mode::trinary;
  bool negate = false;
  double occupied_thresh = 0.0;
  double free_thresh = 0.0;
};

// The YAML mapping of the file, with places for messages.
class MapFile {
 public:
  MapFile(const std::string& text, const std::string& shown_path) : shown_path_(shown_path) {
    try {
      root_ = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      fail(error.mark, error.msg);
    }
    if (!root_.IsMap()) fail(root_.Mark(), "expected 'image: ...' and other keys: this is no map of map_server");
    std::vector<std::string> seen;
    for (const auto& entry : root_) check_key(entry.first, seen);
  }

  [[noreturn]] void fail(const YAML::Mark& mark, std::string text) const {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, ' ');
    const bool known = !mark.is_null() && mark.line >= 0 && mark.column >= 0;
    throw InputError(
        fmt::format("{}:{}:{}: {}", shown_path_, known ? mark.line + 1 : 1, known ? mark.column + 1 : 1, text));
  }

  YAML::Node find(const std::string& key) const {
    for (const auto& entry : root_)
      if (entry.first.IsScalar() && entry.first.Scalar() == key) return entry.second;
    return YAML::Node(YAML::NodeType::Undefined);
  }
  YAML::Node need(const std::string& key) const {
    const YAML::Node node = find(key);
    if (!node.IsDefined()) fail(root_.Mark(), fmt::format("the map needs '{}'", key));
    return node;
  }

  std::string text(const YAML::Node& node, const std::string& key) const {
    if (!node.IsScalar() || node.Scalar().empty()) fail(node.Mark(), fmt::format("'{}' must be a text", key));
    return node.Scalar();
  }

  double number(const YAML::Node& node, const std::string& key, double least, double most) const {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || std::isnan(value))
      fail(node.Mark(), fmt::format("'{}' must be a number{}", key, quoted(node)));
    if (value < least || value > most)
      fail(node.Mark(), fmt::format("'{}' must be from {} to {}, not {}", key, least, most, value));
    return value;
  }

  // Accepts 0 and 1, as map_server writes them, and YAML's booleans.
  bool flag(const YAML::Node& node, const std::string& key) const {
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    if (text == "0" || text == "1") return text == "1";
    bool value = false;
    if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value))
      fail(node.Mark(), fmt::format("'{}' must be 0 or 1{}", key, quoted(node)));
    return value;
  }

 private:
  // Other tools add keys, so an unknown key is refused only if it is probably a mistyped key of map_server.
  void check_key(const YAML::Node& key, std::vector<std::string>& seen) const {
    static const std::vector<std::string> known = {"image",           "resolution",  "origin", "negate",
                                                   "occupied_thresh", "free_thresh", "mode"};
    if (!key.IsScalar()) return;
    const std::string name = key.Scalar();
    if (std::find(seen.begin(), seen.end(), name) != seen.end())
      fail(key.Mark(), fmt::format("'{}' occurs twice", name));
    seen.push_back(name);
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    if (const std::string meant = did_you_mean(name, known); !meant.empty())
      fail(key.Mark(), fmt::format("unknown key '{}'{}", name, meant));
  }

  static std::string quoted(const YAML::Node& node) {
    constexpr std::size_t longest = 24;
    return node.IsScalar() ? fmt::format(", not '{}'", node.Scalar().substr(0, longest)) : "";
  }

  std::string shown_path_;
  YAML::Node root_;
};

dmrp_pose read_origin(const MapFile& file) {
  const YAML::Node node = file.need("origin");
  if (!node.IsSequence() || node.size() != 3) file.fail(node.Mark(), "'origin' must be [x, y, yaw]");
  const double most = max_origin_m;
  return {file.number(node[0], "origin", -most, most), file.number(node[1], "origin", -most, most),
          file.number(node[2], "origin", -most, most)};
}

Mode read_mode(const MapFile& file) {
  const YAML::Node node = file.find("mode");
  if (!node.IsDefined()) return Mode::trinary;
  static const std::vector<std::string> names = {"trinary", "scale", "raw"};
  const std::string name = file.text(node, "mode");
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    file.fail(node.Mark(),
              fmt::format("'mode' must be one of {}, not '{}'{}", join_names(names), name, did_you_mean(name, names)));
  return static_cast<Mode>(found - names.begin());
}

Shades read_shades(const MapFile& file) {
  Shades shades;
  shades.mode = read_mode(file);
  shades.negate = file.flag(file.need("negate"), "negate");
  shades.occupied_thresh = file.number(file.need("occupied_thresh"), "occupied_thresh", 0.0, 1.0);
  const YAML::Node free_thresh = file.need("free_thresh");
  shades.free_thresh = file.number(free_thresh, "free_thresh", 0.0, 1.0);
  if (shades.free_thresh >= shades.occupied_thresh)
    file.fail(free_thresh.Mark(), fmt::format("'free_thresh' must be below 'occupied_thresh', not {} and {}",
                                              shades.free_thresh, shades.occupied_thresh));
  return shades;
}

// The occupancy probability of a cell in per cent; none if it is unknown.
std::optional<int> chance(const MapImage& image, std::size_t pixel, const Shades& shades) {
  double level = image.level[pixel];
  double white = image.white;
  if (shades.mode == Mode::trinary && !image.alpha.empty()) {
    // Like map_server: the mean over all channels, with alpha.
    level += image.alpha[pixel];
    white += 255.0;
  }
  const double shade = level / white;
  if (shades.mode == Mode::raw) {
    const double value = std::round(255.0 * shade);
    return value <= 100.0 ? std::optional<int>(static_cast<int>(value)) : std::nullopt;
  }
  if (shades.mode == Mode::scale && !image.alpha.empty() && image.alpha[pixel] != 255) return std::nullopt;
  const double occupied = shades.negate ? shade : 1.0 - shade;
  if (occupied > shades.occupied_thresh) return 100;
  if (occupied < shades.free_thresh) return 0;
  if (shades.mode == Mode::trinary) return std::nullopt;
  return static_cast<int>(
      std::rint(100.0 * (occupied - shades.free_thresh) / (shades.occupied_thresh - shades.free_thresh)));
}

// Whether map_saver would write an unknown cell like this.
bool is_unknown_grey(const MapImage& image, std::size_t pixel, const Shades& shades) {
  constexpr long unknown_grey = 205;
  return shades.mode == Mode::trinary && !shades.negate && (image.alpha.empty() || image.alpha[pixel] == 255) &&
         std::lround(255.0 * image.level[pixel] / image.white) == unknown_grey;
}

void add_cells(const MapImage& image, const Shades& shades, std::optional<UnknownCells> unknown, RosMap& map) {
  map.cells = {image.width, image.height, std::vector<std::uint8_t>(image.level.size())};
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const std::size_t pixel = std::size_t{y} * image.width + x;
      auto likely = chance(image, pixel, shades);
      const bool is_grey = is_unknown_grey(image, pixel, shades);
      if (is_grey && unknown) likely.reset();
      const bool free = likely ? *likely <= max_free_probability : unknown == UnknownCells::free;
      if (!likely) ++map.unknown;
      if (is_grey && likely && free) ++map.unknown_as_free;
      map.cells.free[std::size_t{image.height - 1 - y} * image.width + x] = free ? 1 : 0;
    }
}

}  // namespace

RosMap read_ros_map(const std::filesystem::path& file, const std::string& shown_path,
                    std::optional<UnknownCells> unknown) {
  const MapFile yaml(read_file(file, shown_path, max_yaml_bytes), shown_path);
  RosMap map;
  const YAML::Node name = yaml.need("image");
  const std::string image = yaml.text(name, "image");
  map.resolution_m = yaml.number(yaml.need("resolution"), "resolution", min_resolution_m, max_resolution_m);
  map.origin = read_origin(yaml);
  const Shades shades = read_shades(yaml);
  map.image = (file.parent_path() / image).lexically_normal();
  if (std::error_code ignored; !std::filesystem::is_regular_file(map.image, ignored))
    yaml.fail(name.Mark(), fmt::format("no file '{}' beside the map file", image));
  const std::string shown_image = (std::filesystem::path(shown_path).parent_path() / image).lexically_normal().string();
  map.free_thresh = shades.free_thresh;
  add_cells(read_map_image(map.image, shown_image), shades, unknown, map);
  return map;
}

}  // namespace dmrp::host
