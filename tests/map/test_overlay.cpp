#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <vector>

#include "incognita/map/overlay.hpp"
#include "reference.hpp"

using namespace incognita;

namespace {

template <class Cell, int Dim>
void require_same_log_odds(const Overlay<Cell, Dim>& overlay, const Map<Cell, Dim>& map) {
  for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
    const Index<Dim> index = map.grid().index_at(offset);
    REQUIRE(overlay.log_odds(index) == map.log_odds(index));
  }
}

template <class Cell, int Dim>
Map<Cell, Dim> scanned_map(Random& random, const Cell& policy) {
  Map<Cell, Dim> map({0.2, 0.5}, policy);
  const Point<Dim> corner = Point<Dim>::Constant(12.0);
  map.reserve({-corner, corner});
  for (int n = 0; n < 5; ++n) {
    map.update(reference::random_scan<Dim>(random, 40, 4.0), reference::random_pose<Dim>(random),
               reference::random_covariance<Dim>(random));
  }
  return map;
}

/// Predicted scans on an overlay against the same scans written into a copy of the map.
template <class Cell, int Dim>
void compare_with_copy(const Cell& policy, int rounds) {
  Random random(1);
  const Map<Cell, Dim> map = scanned_map<Cell, Dim>(random, policy);
  const Map<Cell, Dim> untouched = map;
  Overlay<Cell, Dim> overlay;
  for (int round = 0; round < rounds; ++round) {
    overlay.reset(map);
    REQUIRE(overlay.touched().empty());
    Map<Cell, Dim> copy = map;
    const int scans = static_cast<int>(random.index(5));
    for (int n = 0; n < scans; ++n) {
      const Scan<Dim> scan = reference::random_scan<Dim>(random, 20, 4.0, 0.1);
      const Pose<Dim> T_map_sensor = reference::random_pose<Dim>(random);
      const auto covariance = reference::random_covariance<Dim>(random);
      copy.update(scan, T_map_sensor, covariance);
      overlay.update(scan, T_map_sensor, covariance.template topLeftCorner<Dim, Dim>());
    }
    require_same_log_odds(overlay, copy);
    REQUIRE(&overlay.map() == &map);

    std::set<Offset> touched(overlay.touched().begin(), overlay.touched().end());
    REQUIRE(touched.size() == overlay.touched().size());
    for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
      if (copy.log_odds(offset) != map.log_odds(offset)) REQUIRE(touched.count(offset) == 1);
    }
    for (const Offset offset : overlay.touched()) {
      REQUIRE(overlay.touched_log_odds(offset) == copy.log_odds(offset));
    }
  }
  REQUIRE(map.stamp() == untouched.stamp());
  for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
    REQUIRE(map.log_odds(offset) == untouched.log_odds(offset));
  }
}

}  // namespace

TEST_CASE("An overlay is what a copied map would be, and leaves the map alone", "[map]") {
  compare_with_copy<TBayes, 2>(TBayes(), 12);
  compare_with_copy<TBayes, 2>(TBayes(TBayes::literal_params()), 4);
  compare_with_copy<LogOdds, 2>(LogOdds(), 4);
}

TEST_CASE("An overlay in space is what a copied map would be", "[map]") {
  Random random(2);
  Map<LogOdds, 3> map({0.25, 0.5});
  map.reserve({Point<3>::Constant(-7.0), Point<3>::Constant(7.0)});
  Map<LogOdds, 3> copy = map;
  Overlay<LogOdds, 3> overlay;
  overlay.reset(map);
  for (int n = 0; n < 4; ++n) {
    const Scan<3> scan = reference::random_scan<3>(random, 30, 3.0);
    const Pose3 T_map_sensor = reference::random_pose<3>(random);
    copy.update(scan, T_map_sensor, Eigen::Matrix<double, 6, 6>::Identity());
    overlay.update(scan, T_map_sensor, Eigen::Matrix3d::Identity());
  }
  require_same_log_odds(overlay, copy);
}

TEST_CASE("An overlay lists the cells it touched in the order of their first touch", "[map]") {
  Map<LogOdds> map({1.0, 0.5});
  map.reserve({{-1.0, -1.0}, {12.0, 12.0}});
  Overlay<LogOdds> overlay;
  overlay.reset(map);
  const Scan<2> scan(planar_beams(1, 0.0, 0.0, 10.0), {3.0});
  const auto offset_of = [&](int x) { return map.grid().offset_of({x, 0}); };
  overlay.update(scan, {0.5, 0.5, 0.0}, Eigen::Matrix2d::Zero());
  // The hit first: the face at 3.5 m, pushed by half a cell to 4.0.
  const std::vector<Offset> expected{offset_of(4), offset_of(0), offset_of(1), offset_of(2), offset_of(3)};
  REQUIRE(overlay.touched() == expected);
  overlay.update(scan, {0.5, 0.5, 0.0}, Eigen::Matrix2d::Zero());
  REQUIRE(overlay.touched() == expected);
  overlay.reset(map);
  REQUIRE(overlay.touched().empty());
}

TEST_CASE("An overlay forgets its changes however often it starts over", "[map]") {
  Random random(3);
  const Map<> map = scanned_map<TBayes, 2>(random, TBayes());
  Overlay<TBayes> overlay;
  const Scan<2> scan(planar_beams(1, 0.0, 0.0, 10.0), {3.0});
  const Index<2> cell = map.lattice().index_of({9.1, 10.1});
  float first = 0.0F;
  for (int n = 0; n < 100000; ++n) {
    overlay.reset(map);
    REQUIRE(overlay.log_odds(cell) == map.log_odds(cell));
    overlay.update(scan, {8.1, 10.1, 0.0}, Eigen::Matrix2d::Zero());
    if (n == 0) first = overlay.log_odds(cell);
    REQUIRE(overlay.log_odds(cell) == first);
  }
  REQUIRE(first < map.log_odds(cell));
}

TEST_CASE("An overlay follows a map that grew, and looks at another one", "[map]") {
  Random random(4);
  Map<> map = scanned_map<TBayes, 2>(random, TBayes());
  Overlay<TBayes> overlay;
  overlay.reset(map);
  overlay.update(reference::random_scan<2>(random, 40, 4.0), {}, Eigen::Matrix2d::Zero());
  REQUIRE(overlay.log_odds({100000, 0}) == 0.0F);
  map.update(reference::random_scan<2>(random, 40, 4.0), {40.0, -30.0, 0.0}, Eigen::Matrix3d::Zero());
  overlay.reset(map);
  require_same_log_odds(overlay, map);
  const Map<> other = scanned_map<TBayes, 2>(random, TBayes());
  overlay.reset(other);
  require_same_log_odds(overlay, other);
}

TEST_CASE("An overlay refuses more predicted scans than there are stamps for", "[map]") {
  Map<LogOdds> map;
  const Scan<2> none(circular_beams(0, 10.0));
  Overlay<LogOdds> overlay;
  // The worst map: one at its last stamp leaves 5,535.
  while (map.stamp() < Map<LogOdds>::stamp_last) map.update(none, {}, Eigen::Matrix3d::Zero());
  overlay.reset(map);
  for (int n = 0; n < 5535; ++n) overlay.update(none, {}, Eigen::Matrix2d::Zero());
  REQUIRE_THROWS_AS(overlay.update(none, {}, Eigen::Matrix2d::Zero()), std::length_error);
  overlay.reset(map);
  REQUIRE_NOTHROW(overlay.update(none, {}, Eigen::Matrix2d::Zero()));
}

TEST_CASE("An overlay refuses a predicted scan that reaches out of the map's box, and stays as it was", "[map]") {
  Random random(6);
  const Map<> map = scanned_map<TBayes, 2>(random, TBayes());
  Overlay<TBayes> overlay;
  overlay.reset(map);
  const Box<Index<2>> box = map.grid().box();
  const Eigen::Vector2d corner = map.lattice().center_m({box.upper.x() - 3, box.upper.y() - 3});
  const Scan<2> east(planar_beams(1, 0.0, 0.0, 10.0), {1.0});
  for (const double yaw_rad : {0.0, 0.5 * std::numbers::pi}) {
    const Pose2 outward{corner.x(), corner.y(), yaw_rad};
    REQUIRE_THROWS_AS(overlay.update(east, outward, Eigen::Matrix2d::Zero()), std::length_error);
  }
  REQUIRE(overlay.touched().empty());
  REQUIRE_NOTHROW(overlay.update(east, {corner.x() - 1.5, corner.y(), 0.0}, Eigen::Matrix2d::Zero()));
}
