#include <catch2/catch.hpp>
#include <cstddef>
#include <string>

#include "incognita/io/kth_floor.hpp"
#include "kth_text.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

const std::string good_floor = io_test::two_rooms(io_test::KthText(), 0.2).text();

std::string floor_refusal(const std::string& xml) {
  return refusal([&] { return parse_kth_floor(xml, "a.xml"); });
}

std::string exchanged(const std::string& what, const std::string& by) {
  std::string text = good_floor;
  const std::size_t place = text.find(what);
  REQUIRE(place != std::string::npos);
  return text.replace(place, what.size(), by);
}

}  // namespace

TEST_CASE("KTH floor: rooms in metres, as the file has them") {
  const KthFloor floor = parse_kth_floor(good_floor, "x");
  REQUIRE(floor.spaces.size() == 2);
  const KthSpace& left = floor.spaces[0];
  CHECK(left.name == "left");
  REQUIRE(left.contours.size() == 1);
  REQUIRE(left.contours[0].size() == 6);
  CHECK(left.contours[0][1].from_m == Point<2>(4.0, 0.0));
  CHECK(left.contours[0][1].to_m == Point<2>(4.0, 1.1));
  CHECK(left.contours[0][1].type == KthSegmentType::wall);
  CHECK(left.contours[0][2].type == KthSegmentType::portal);
  CHECK(left.contours[0][2].target == "right");
  CHECK(left.contours[0][5].type == KthSegmentType::window);
  CHECK(floor.spaces[1].contours[0][0].from_m.x() == Approx(4.2));
}

TEST_CASE("KTH floor: metres are coordinates times RealDistance / PixelDistance") {
  const KthFloor floor = parse_kth_floor(exchanged("RealDistance=\"10\"", "RealDistance=\"5\""), "x");
  CHECK(floor.spaces[0].contours[0][1].from_m.x() == Approx(2.0));
}

TEST_CASE("KTH floor: a scale that is missing or not positive is refused") {
  CHECK_THAT(floor_refusal(exchanged("<Scale PixelDistance=\"1000\" RealDistance=\"10\"/>", "")),
             Contains("a.xml: Scale is missing"));
  for (const char* value : {"0", "-1", "nan", "inf", "", "ten", "1e999"}) {
    CHECK_THAT(
        floor_refusal(exchanged("PixelDistance=\"1000\"", std::string("PixelDistance=\"") + value + "\"")),
        Contains("Scale's PixelDistance is \"") && Contains("must be a number > 0"));
    CHECK_THAT(floor_refusal(exchanged("RealDistance=\"10\"", std::string("RealDistance=\"") + value + "\"")),
               Contains("Scale's RealDistance"));
  }
  CHECK_THAT(floor_refusal(exchanged(" PixelDistance=\"1000\"", "")),
             Contains("Scale's PixelDistance is \"\""));
}

TEST_CASE("KTH floor: a space of fewer than three points is refused by its name") {
  const std::string line = "<linesegment x1=\"0\" y1=\"0\" x2=\"9\" y2=\"0\" type=\"Wall\"/>";
  const std::string back = "<linesegment x1=\"9\" y1=\"0\" x2=\"0\" y2=\"0\" type=\"Wall\"/>";
  const std::string point = "<linesegment x1=\"0\" y1=\"0\" x2=\"0\" y2=\"0\" type=\"Wall\"/>";
  const auto with_space = [](const std::string& content) {
    return exchanged("</floor>", "<space name=\"A 17\"><contour>" + content + "</contour></space></floor>");
  };
  CHECK_THAT(floor_refusal(with_space(line)),
             Contains("space \"A 17\" has a contour of 2 points, but must have at least 3"));
  CHECK_THAT(floor_refusal(with_space(line + back)), Contains("contour of 2 points"));
  CHECK_THAT(floor_refusal(with_space(line + back + line + back)), Contains("contour of 2 points"));
  CHECK_THAT(floor_refusal(with_space(point + point + point)), Contains("contour of 1 point,"));
  CHECK_THAT(floor_refusal(with_space("")), Contains("contour of 0 points"));
  CHECK_THAT(floor_refusal(exchanged("</floor>", "<space name=\"A 17\"/></floor>")),
             Contains("space \"A 17\" has no contour"));
}

TEST_CASE("KTH floor: bad coordinates and types are refused by the space's name") {
  const std::string x1 = "x1=\"0\"";
  for (const char* value : {"", "abc", "nan", "inf", "1 2", "0x1"}) {
    CHECK_THAT(floor_refusal(exchanged(x1, std::string("x1=\"") + value + "\"")),
               Contains("space \"left\": x1 is \"" + std::string(value) + "\", but must be a finite number"));
  }
  CHECK_THAT(floor_refusal(exchanged(x1, "")), Contains("space \"left\": x1 is \"\""));
  CHECK_THAT(floor_refusal(exchanged(x1, "x1=\"1e30\"")), Contains("x1 lies 1e+28 m away"));
  CHECK_THAT(floor_refusal(exchanged("type=\"Wall\"", "type=\"Door\"")),
             Contains("space \"left\": a type is \"Door\""));
  CHECK_THAT(
      floor_refusal(exchanged("name=\"left\"><contour>", "name=\"a&#10;b\"><contour><linesegment x1=\"\"/>")),
      Contains("space \"a b\": x1"));
}

TEST_CASE("KTH floor: what is no KTH floor is refused in one line") {
  CHECK_THAT(floor_refusal(""), Contains("not valid XML"));
  CHECK_THAT(floor_refusal("words"), Contains("a.xml: "));
  CHECK_THAT(floor_refusal("<floor><Scale></floor>"), Contains("not valid XML") && Contains("at byte"));
  CHECK_THAT(floor_refusal("<svg/>"), Contains("the outermost element must be floor"));
  CHECK_THAT(floor_refusal("<floor><Scale PixelDistance=\"1\" RealDistance=\"1\"/></floor>"),
             Contains("there are no spaces"));
}

TEST_CASE("KTH floor: hostile files end at once") {
  std::string deep = "<floor>";
  for (int i = 0; i < 500000; ++i) deep += "<a>";
  CHECK_THAT(floor_refusal(deep), Contains("not valid XML"));
  for (int i = 0; i < 500000; ++i) deep += "</a>";
  CHECK_THAT(floor_refusal(deep + "</floor>"), Contains("Scale is missing"));

  const std::string bomb =
      "<!DOCTYPE floor [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\"><!ENTITY c "
      "\"&b;&b;&b;&b;\">]>";
  CHECK_THAT(floor_refusal(bomb + "<floor><Scale PixelDistance=\"&c;\" RealDistance=\"1\"/></floor>"),
             Contains("\"&c;\""));
  CHECK_THAT(floor_refusal("<!DOCTYPE floor SYSTEM \"file:///etc/passwd\"><floor/>"),
             Contains("Scale is missing"));

  std::string many = "<floor><Scale PixelDistance=\"1\" RealDistance=\"1\"/><space name=\"s\"><contour>";
  for (int i = 0; i < 20001; ++i) many += "<linesegment x1=\"0\" y1=\"0\" x2=\"1\" y2=\"1\" type=\"Wall\"/>";
  CHECK_THAT(floor_refusal(many + "</contour></space></floor>"), Contains("more than 20000 line segments"));
}

TEST_CASE("KTH floor: files cut off or spoilt are read or refused") {
  for (std::size_t size = 0; size + 1 < good_floor.size(); ++size) {
    CAPTURE(size);
    CHECK_FALSE(floor_refusal(good_floor.substr(0, size)).empty());
  }
  CHECK(io_test::refused_when_spoilt(
            good_floor, 4000, [](const std::string& xml) { return parse_kth_floor(xml, "x"); }) > 1000);
}
