/// The YAML file of a ROS map_server map: what the pixels of its image mean.
#pragma once

#include <yaml-cpp/yaml.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "incognita/grid/lattice.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/read_file.hpp"

namespace incognita {

/// How map_server reads a pixel; see probabilities_of.
enum class MapMode {
  trinary,  ///< occupied, free or unknown
  scale,    ///< a probability between the thresholds
  raw       ///< a probability in percent
};

/// The fields of a map_server YAML file. The defaults are what map_saver writes.
struct MapMetadata {
  std::filesystem::path image;           ///< ready to be opened: relative names are resolved against the YAML's folder
  double resolution_m = 0.05;            ///< metres per pixel
  Point<2> origin_m = Point<2>::Zero();  ///< the lower left corner of the lower left pixel
  bool negate = false;                   ///< white is occupied instead of black
  double occupied_thresh = 0.65;         ///< more than this probability is occupied
  double free_thresh = 0.196;            ///< less than this probability is free
  MapMode mode = MapMode::trinary;       ///< trinary where the file names none
};

namespace detail {

/// The fields of one YAML document by name, each with an error that names it.
class MapFields {
 public:
  MapFields(const YAML::Node& root, const std::filesystem::path& file) : root_(root), file_(file) {}

  [[nodiscard]] std::optional<std::string> find(const char* name) const {
    const YAML::Node node = root_[name];
    if (!node || node.IsNull()) return std::nullopt;
    return scalar(node, name);
  }

  [[nodiscard]] std::string text(const char* name) const {
    std::optional<std::string> value = find(name);
    if (!value) throw InputError(file_, std::string(name) + " is missing");
    return *value;
  }

  [[nodiscard]] double number(const char* name, double min, double max) const {
    return number(text(name), name, min, max);
  }

  /// Three numbers: x, y and yaw.
  [[nodiscard]] Point<2> origin() const {
    constexpr double far_m = 1e7;
    const YAML::Node node = root_["origin"];
    if (!node) throw InputError(file_, "origin is missing");
    if (!node.IsSequence() || node.size() != 3) {
      const std::string found = node.IsSequence() ? "has " + std::to_string(node.size()) + " values" : "is no sequence";
      throw InputError(file_, "origin " + found + ", but must be three numbers [x, y, yaw]");
    }
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) {
      values[i] = number(scalar(node[i], "origin"), "origin", -far_m, far_m);
    }
    if (values[2] != 0.0) {
      throw InputError(file_, "origin has a yaw of " + format_number(values[2]) +
                                  ", but must have 0: turned maps are not supported");
    }
    return {values[0], values[1]};
  }

  [[nodiscard]] bool flag(const char* name) const {
    const std::string value = text(name);
    if (value == "0" || value == "1") return value == "1";
    bool truth = false;
    if (YAML::convert<bool>::decode(YAML::Node(value), truth)) return truth;
    throw InputError(file_, std::string(name) + " is " + shown(value) + ", but must be 0, 1, true or false");
  }

 private:
  [[nodiscard]] std::string scalar(const YAML::Node& node, const char* name) const {
    if (!node.IsScalar()) {
      throw InputError(file_, std::string(name) + (node.IsSequence() ? " is a sequence" : " is a mapping or empty") +
                                  ", but must be a single value");
    }
    return node.Scalar();
  }

  [[nodiscard]] double number(const std::string& value, const char* name, double min, double max) const {
    const std::optional<double> parsed = parse_number(value);
    if (parsed && *parsed >= min && *parsed <= max) return *parsed;
    throw InputError(file_, std::string(name) + " is " + shown(value) + ", but must be a number from " +
                                format_number(min) + " to " + format_number(max));
  }

  const YAML::Node& root_;
  const std::filesystem::path& file_;
};

}  // namespace detail

/// Reads the text of a map_server YAML file. All fields but mode are required, as ROS does; others are
/// ignored. `file` is named in errors, and its folder is where a relative image name starts. Stricter than
/// ROS: the yaw of the origin must be 0, the resolution within 1e-4..1e3 m and 0 <= free_thresh <
/// occupied_thresh <= 1. Throws InputError.
[[nodiscard]] inline MapMetadata parse_map_metadata(const std::string& text,
                                                    const std::filesystem::path& file) {
  try {
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) throw InputError(file, "is not a map description: it holds no fields");
    const detail::MapFields fields(root, file);
    MapMetadata metadata;
    metadata.resolution_m = fields.number("resolution", 1e-4, 1e3);
    metadata.origin_m = fields.origin();
    metadata.negate = fields.flag("negate");
    metadata.occupied_thresh = fields.number("occupied_thresh", 0.0, 1.0);
    metadata.free_thresh = fields.number("free_thresh", 0.0, 1.0);
    if (!(metadata.free_thresh < metadata.occupied_thresh)) {
      throw InputError(file, "free_thresh is " + format_number(metadata.free_thresh) +
                                 ", but must be less than occupied_thresh, which is " +
                                 format_number(metadata.occupied_thresh));
    }
    const std::string mode = fields.find("mode").value_or("trinary");
    if (mode != "trinary" && mode != "scale" && mode != "raw") {
      throw InputError(file, "mode is " + shown(mode) + ", but must be trinary, scale or raw");
    }
    metadata.mode = mode == "trinary" ? MapMode::trinary : mode == "scale" ? MapMode::scale : MapMode::raw;
    const std::string image = fields.text("image");
    if (image.empty() || image.find('\0') != std::string::npos) throw InputError(file, "image is " + shown(image) + ", but must name a file");
    metadata.image = file.parent_path() / image;
    return metadata;
  } catch (const YAML::Exception& error) {
    throw InputError(file, std::string("not valid YAML: ") + error.what());
  }
}

/// Reads a map_server YAML file; see parse_map_metadata.
[[nodiscard]] inline MapMetadata read_map_metadata(const std::filesystem::path& file) {
  return parse_map_metadata(read_file(file, std::size_t{1} << 16), file);
}

/// The text of a map_server YAML file; of the image its file name alone, as it lies beside the YAML.
[[nodiscard]] inline std::string map_metadata_text(const MapMetadata& metadata) {
  constexpr std::array<const char*, 3> modes{"trinary", "scale", "raw"};
  YAML::Emitter yaml;
  yaml << YAML::BeginMap;
  yaml << YAML::Key << "image" << YAML::Value << metadata.image.filename().string();
  yaml << YAML::Key << "mode" << YAML::Value << modes.at(static_cast<std::size_t>(metadata.mode));
  yaml << YAML::Key << "resolution" << YAML::Value << format_number(metadata.resolution_m);
  yaml << YAML::Key << "origin" << YAML::Value << YAML::Flow << YAML::BeginSeq
       << format_number(metadata.origin_m.x()) << format_number(metadata.origin_m.y()) << "0" << YAML::EndSeq;
  yaml << YAML::Key << "negate" << YAML::Value << (metadata.negate ? "1" : "0");
  yaml << YAML::Key << "occupied_thresh" << YAML::Value << format_number(metadata.occupied_thresh);
  yaml << YAML::Key << "free_thresh" << YAML::Value << format_number(metadata.free_thresh);
  yaml << YAML::EndMap;
  return std::string(yaml.c_str()) + '\n';
}

}  // namespace incognita
