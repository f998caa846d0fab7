#include <catch2/catch.hpp>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "incognita/io/map_metadata.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

const std::string good_metadata =
    "image: map.pgm\n"
    "resolution: 0.05\n"
    "origin: [-10.0, 2.5, 0.0]\n"
    "negate: 0\n"
    "occupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";

/// `good_metadata` with one line exchanged, or taken out when `line` is empty.
std::string with_line(std::string_view key, const std::string& line) {
  std::string text = good_metadata;
  const std::size_t start = text.find(std::string(key) + ":");
  return text.replace(start, text.find('\n', start) + 1 - start, line.empty() ? "" : line + "\n");
}

MapMetadata parse_metadata(const std::string& text) { return parse_map_metadata(text, "maps/m.yaml"); }

std::string metadata_refusal(const std::string& text) {
  return refusal([&] { return parse_metadata(text); });
}

}  // namespace

TEST_CASE("map metadata: the fields of map_saver's file") {
  const MapMetadata metadata = parse_metadata(good_metadata);
  CHECK(metadata.image == "maps/map.pgm");
  CHECK(metadata.resolution_m == 0.05);
  CHECK(metadata.origin_m == Point<2>(-10.0, 2.5));
  CHECK_FALSE(metadata.negate);
  CHECK(metadata.occupied_thresh == 0.65);
  CHECK(metadata.free_thresh == 0.196);
  CHECK(metadata.mode == MapMode::trinary);
}

TEST_CASE("map metadata: other ways to write them") {
  CHECK(parse_metadata(with_line("image", "image: /elsewhere/a b.png")).image == "/elsewhere/a b.png");
  CHECK(parse_metadata(with_line("image", "image: \"sub/m.png\"")).image == "maps/sub/m.png");
  CHECK(parse_map_metadata(good_metadata, "m.yaml").image == "map.pgm");
  for (const char* yes : {"1", "true", "True", "yes"})
    CHECK(parse_metadata(with_line("negate", std::string("negate: ") + yes)).negate);
  for (const char* no : {"0", "false", "FALSE", "no"}) {
    CHECK_FALSE(parse_metadata(with_line("negate", std::string("negate: ") + no)).negate);
  }
  CHECK(parse_metadata(good_metadata + "mode: trinary\n").mode == MapMode::trinary);
  CHECK(parse_metadata(good_metadata + "mode: scale\n").mode == MapMode::scale);
  CHECK(parse_metadata(good_metadata + "mode: raw\n").mode == MapMode::raw);
  CHECK(parse_metadata(good_metadata + "mode:\n").mode == MapMode::trinary);
  CHECK(parse_metadata(good_metadata + "more: {of: [what, we]}\n").resolution_m == 0.05);
  CHECK(
      parse_metadata(
          "{image: a, resolution: 1e-1, origin: [1, 2, -0.0], negate: 1, occupied_thresh: 1, free_thresh: 0}")
          .resolution_m == 0.1);
  CHECK(parse_metadata(with_line("origin", "origin:\n  - 1\n  - 2\n  - 0")).origin_m == Point<2>(1.0, 2.0));
}

TEST_CASE("map metadata: every field but mode is required") {
  for (const char* key : {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"}) {
    CHECK(metadata_refusal(with_line(key, "")) == "maps/m.yaml: " + std::string(key) + " is missing");
  }
}

TEST_CASE("map metadata: bad values are refused with the value and its bound") {
  for (const char* value :
       {"0", "-0.05", "nan", ".inf", "inf", "1e-5", "1e9", "abc", "\"\"", "0.05m", "1e999"}) {
    CAPTURE(value);
    CHECK_THAT(metadata_refusal(with_line("resolution", std::string("resolution: ") + value)),
               Contains("maps/m.yaml: resolution is ") && Contains("from 1e-04 to 1000"));
  }
  CHECK_THAT(metadata_refusal(with_line("resolution", "resolution: [0.05]")),
             Contains("resolution is a") && Contains("but must be a single value"));
  CHECK_THAT(metadata_refusal(with_line("resolution", "resolution: {a: 1}")),
             Contains("resolution is a") && Contains("but must be a single value"));
  CHECK_THAT(metadata_refusal(with_line("free_thresh", "free_thresh: 0.65")),
             Contains("free_thresh is 0.65, but must be less than occupied_thresh, which is 0.65"));
  CHECK_THAT(metadata_refusal(with_line("free_thresh", "free_thresh: -0.1")),
             Contains("free_thresh is \"-0.1\""));
  CHECK_THAT(metadata_refusal(with_line("occupied_thresh", "occupied_thresh: 1.1")), Contains("from 0 to 1"));
  CHECK_THAT(metadata_refusal(with_line("occupied_thresh", "occupied_thresh: nan")), Contains("from 0 to 1"));
  CHECK_THAT(metadata_refusal(with_line("negate", "negate: 2")), Contains("negate is \"2\""));
  CHECK_THAT(metadata_refusal(with_line("negate", "negate: maybe")), Contains("negate is \"maybe\""));
  CHECK_THAT(metadata_refusal(good_metadata + "mode: Scale\n"),
             Contains("mode is \"Scale\", but must be trinary, scale or raw"));
  CHECK_THAT(metadata_refusal(good_metadata + "mode: [raw]\n"), Contains("mode is a sequence, but must be a single value"));
  for (const char* value : {"[0, 0]", "[0, 0, 0, 0]", "0", "{x: 0, y: 0, z: 0}"}) {
    CHECK_THAT(metadata_refusal(with_line("origin", std::string("origin: ") + value)),
               Contains("origin ") && Contains("but must be three"));
  }
  CHECK_THAT(metadata_refusal(with_line("origin", "origin: [0, x, 0]")), Contains("origin is \"x\""));
  CHECK_THAT(metadata_refusal(with_line("origin", "origin: [0, .nan, 0]")), Contains("origin is \".nan\""));
  CHECK_THAT(metadata_refusal(with_line("origin", "origin: [1e8, 0, 0]")), Contains("origin is \"1e8\""));
  CHECK_THAT(metadata_refusal(with_line("origin", "origin: [[0], 0, 0]")),
             Contains("origin is a") && Contains("but must be a single value"));
  CHECK_THAT(metadata_refusal(with_line("origin", "origin: [0, 0, 0.1]")),
             Contains("yaw of 0.1") && Contains("not supported"));
  CHECK_THAT(metadata_refusal(with_line("image", "image: \"\"")), Contains("image is \"\", but must name a file"));
  CHECK_THAT(metadata_refusal(with_line("image", "image: \"a\\0b\"")), Contains("but must name a file"));
  CHECK_THAT(metadata_refusal(with_line("image", "image: [a]")), Contains("image is a sequence, but must be a single value"));
}

TEST_CASE("map metadata: what is no map description is refused in one line") {
  for (const char* text : {"", "\n", "just words", "- a\n- b", "42", "---\n", "# comment"}) {
    CHECK_THAT(metadata_refusal(text), Contains("maps/m.yaml: "));
  }
  CHECK_THAT(metadata_refusal("image: [unclosed"), Contains("not valid YAML") && Contains("line 1"));
  CHECK_THAT(metadata_refusal("\tb: 1\n: :"), Contains("not valid YAML"));
  CHECK_THAT(metadata_refusal(std::string(100, '\xFF')), Contains("maps/m.yaml"));
}

TEST_CASE("map metadata: hostile files end at once") {
  const auto begin = std::chrono::steady_clock::now();
  constexpr int many = 60000;
  CHECK_FALSE(metadata_refusal(std::string(many, '[')).empty());
  CHECK_FALSE(metadata_refusal(std::string(many, '{')).empty());
  std::string nested = "a: ";
  for (int i = 0; i < many / 2; ++i) nested += "- ";
  CHECK_FALSE(metadata_refusal(nested).empty());
  std::string aliases = "a: &a [x, x, x, x, x, x, x, x, x]\n";
  for (char name = 'b'; name <= 'z'; ++name) {
    const std::string before{'*', static_cast<char>(name - 1)};
    aliases += std::string(1, name) + ": &" + name + " [" + before;
    for (int i = 0; i < 8; ++i) aliases += ", " + before;
    aliases += "]\n";
  }
  CHECK(parse_metadata(good_metadata + aliases).resolution_m == 0.05);
  CHECK_FALSE(metadata_refusal(aliases + "resolution: *z\n").empty());
  CHECK_FALSE(metadata_refusal("&a a: *a\n").empty());
  CHECK(metadata_refusal(with_line("resolution", "resolution: " + std::string(many, 'x'))).size() < 200);
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));

  const io_test::TemporaryFolder folder;
  const auto large = folder.with("m.yaml", good_metadata + std::string(70000, '#'));
  CHECK_THAT(refusal([&] { return read_map_metadata(large); }), Contains("at most 65536"));
}

TEST_CASE("map metadata: files cut off or spoilt are read or refused") {
  for (std::size_t size = 0; size + 6 < good_metadata.size(); ++size) {
    CAPTURE(size);
    CHECK_FALSE(metadata_refusal(good_metadata.substr(0, size)).empty());
  }
  CHECK(io_test::refused_when_spoilt(good_metadata + "mode: scale\n", 3000, parse_metadata) > 500);
  CHECK(io_test::refused_when_spoilt(
            "a: &a [1, {b: *a, ? c : d}]\n? |\n  block\n: >-\n  folded\n'q': \"\\x41\"\n", 3000, parse_metadata) >
        2000);
}

TEST_CASE("map metadata: what is written is read back") {
  MapMetadata metadata;
  metadata.resolution_m = 0.1 + 0.2;
  metadata.origin_m = {-1.0 / 3.0, 1e-17};
  metadata.mode = MapMode::raw;
  metadata.negate = true;
  metadata.occupied_thresh = 1.0;
  metadata.free_thresh = 0.0;
  for (const char* name : {"map.png", "a b.png", "with: colon.png", "#.png", "*.png", "true", "quo\"te'.png",
                           "\xC3\xB6.png", "- x"}) {
    metadata.image = std::filesystem::path("far/away") / name;
    const MapMetadata back = parse_map_metadata(map_metadata_text(metadata), "near/m.yaml");
    CHECK(back.image == std::filesystem::path("near") / name);
    CHECK(back.resolution_m == metadata.resolution_m);
    CHECK(back.origin_m == metadata.origin_m);
    CHECK(back.mode == MapMode::raw);
    CHECK(back.negate);
    CHECK(back.occupied_thresh == 1.0);
    CHECK(back.free_thresh == 0.0);
  }
  metadata.image = "map.png";
  metadata.resolution_m = 0.05;
  metadata.origin_m = {-1.5, 2.0};
  CHECK(map_metadata_text(metadata) ==
        "image: map.png\nmode: raw\nresolution: 0.05\norigin: [-1.5, 2, 0]\nnegate: 1\noccupied_thresh: "
        "1\nfree_thresh: 0\n");
}
