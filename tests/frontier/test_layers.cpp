#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "../map/reference.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "incognita/entropy/log_odds_table.hpp"
#include "incognita/frontier/frontier_layer.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/entropy_layer.hpp"

using namespace incognita;

namespace {

/// Everything that follows a map, against itself recomputed from the whole map.
template <class Cell>
class Followers {
 public:
  Followers(const Lattice<2>& lattice, const FrontierParams& params)
      : params_(params), entropy_(Behavioral{0.7}), occupancy_(lattice), frontier_(lattice, params), information_(lattice, entropy_) {}

  void follow(const Map<Cell>& map) {
    occupancy_.follow(map);
    frontier_.follow(occupancy_);
    information_.follow(map);
  }

  void rebuild(const Map<Cell>& map) {
    occupancy_.rebuild(map);
    frontier_.rebuild(occupancy_);
    information_.rebuild(map);
  }

  void require_same_as_all_anew(const Map<Cell>& map) {
    const OccupancyGrid<2> occupancy = classify(map);
    std::size_t known = 0;
    std::size_t wrong = 0;
    for (Offset offset = 0; offset < static_cast<Offset>(occupancy.size()); ++offset) {
      const Index<2> index = occupancy.index_at(offset);
      const bool is_right = occupancy_.grid().value(index) == occupancy[offset] &&
                            occupancy_.free().get(index) == (occupancy[offset] == Occupancy::free) &&
                            occupancy_.occupied().get(index) == (occupancy[offset] == Occupancy::occupied);
      wrong += static_cast<std::size_t>(!is_right);
      known += static_cast<std::size_t>(occupancy[offset] != Occupancy::unknown);
    }
    REQUIRE(wrong == 0);
    const Occupancy unknown = Occupancy::unknown;
    const auto& followed = occupancy_.grid().values();
    REQUIRE(followed.size() - static_cast<std::size_t>(std::count(followed.begin(), followed.end(), unknown)) == known);
    REQUIRE(frontier_.cells() == detect_frontier<2>(occupancy, params_));
    EntropyLayer<EntropyTable> anew(map.lattice(), entropy_);
    anew.rebuild(map);
    REQUIRE(information_.information_nats() == anew.information_nats());
  }

  [[nodiscard]] double information_nats() const { return information_.information_nats(); }
  [[nodiscard]] const EntropyTable& entropy() const { return entropy_; }
  [[nodiscard]] std::size_t frontier_size() { return frontier_.cells().size(); }

 private:
  FrontierParams params_;
  EntropyTable entropy_;
  OccupancyLayer<2> occupancy_;
  FrontierLayer<2> frontier_;
  EntropyLayer<EntropyTable> information_;
};

/// A scan with neighbouring beams of like range, as rooms give, and some that go astray.
Scan<2> room_scan(Random& random) {
  Scan<2> scan(circular_beams(90, 6.0));
  double range_m = random.uniform(0.5, 6.0);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (random.uniform() < 0.1) range_m = random.uniform(0.5, 6.0);
    scan.set_range_m(beam, random.uniform() < 0.05 ? 6.0 : std::min(5.9, range_m + random.uniform(0.0, 0.1)));
  }
  return scan;
}

template <class Cell>
void follow_scans(const Cell& policy, const FrontierParams& params, int scans, double spread_m) {
  Random random(1);
  Map<Cell> map({0.2, 0.5}, policy);
  Followers<Cell> followers(map.lattice(), params);
  std::size_t most_frontier = 0;
  for (int n = 0; n < scans; ++n) {
    if (n % 97 == 50) map.reserve({Point<2>::Constant(-0.05 * n), Point<2>::Constant(0.02 * n)});
    const Pose2 T_map_sensor{random.uniform(-spread_m, spread_m), random.uniform(-spread_m, spread_m), random.uniform(-3.0, 3.0)};
    map.update(room_scan(random), T_map_sensor, Eigen::Matrix3d::Identity() * random.uniform(1e-4, 1e-2));
    followers.follow(map);
    CAPTURE(n);
    followers.require_same_as_all_anew(map);
    most_frontier = std::max(most_frontier, followers.frontier_size());
  }
  REQUIRE(most_frontier > 50);
  double information_nats = 0.0;
  for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
    information_nats += followers.entropy()(0.0F) - followers.entropy()(map.log_odds(offset));
  }
  REQUIRE(followers.information_nats() == Approx(information_nats).epsilon(1e-9));

  Followers<Cell> anew(map.lattice(), params);
  anew.rebuild(map);
  anew.require_same_as_all_anew(map);
  map.update(room_scan(random), {}, Eigen::Matrix3d::Zero());
  anew.follow(map);
  anew.require_same_as_all_anew(map);
}

}  // namespace

TEST_CASE("What follows a map is what the whole map gives, after every one of a thousand scans", "[frontier]") {
  follow_scans(TBayes(), {}, 1000, 8.0);
}

TEST_CASE("What follows a map of log-odds, with any unknown cell a frontier", "[frontier]") {
  FrontierParams any;
  any.ignore_unknown_near_walls = false;
  follow_scans(LogOdds(), any, 200, 12.0);
}

TEST_CASE("What follows a map where an unknown cell across a corner makes a frontier", "[frontier]") {
  FrontierParams corners;
  corners.unknown_adjacency = Adjacency::corners;
  follow_scans(TBayes(), corners, 100, 8.0);
}

TEST_CASE("Cells that are closed are no frontier and make none", "[frontier]") {
  Random random(7);
  Map<TBayes> map({0.2, 0.5});
  CellBits closed(map.lattice(), false);
  closed.grow_to_include({{-200, -200}, {200, 200}});
  for (int y = -200; y < 200; ++y) {
    for (int x = -200; x < 200; ++x) closed.set({x, y}, x + y / 2 > 10 || (x > -12 && x < -4 && y > -9));
  }
  OccupancyLayer<2> occupancy(map.lattice());
  FrontierLayer<2> frontier(map.lattice());
  FrontierLayer<2> open(map.lattice());
  std::size_t left_out = 0;
  for (int n = 0; n < 60; ++n) {
    map.update(room_scan(random), {random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-3.0, 3.0)},
               Eigen::Matrix3d::Identity() * 1e-3);
    occupancy.follow(map);
    frontier.follow(occupancy, &closed);
    open.follow(occupancy);
    const auto is_near_wall = [&](const Index<2>& cell) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (occupancy.grid().value({cell[0] + dx, cell[1] + dy}) == Occupancy::occupied) return true;
        }
      }
      return false;
    };
    std::vector<Index<2>> expected;
    for (const Index<2>& cell : open.cells()) {
      bool opens = false;
      for (const Index<2>& step : neighbor_steps<2>(Adjacency::faces)) {
        const Index<2> beside = cell + step;
        opens = opens || (occupancy.grid().value(beside) == Occupancy::unknown && !closed.get(beside) && !is_near_wall(beside));
      }
      if (opens && !closed.get(cell)) expected.push_back(cell);
    }
    left_out += open.cells().size() - expected.size();
    CAPTURE(n);
    REQUIRE(frontier.cells() == expected);
  }
  REQUIRE(left_out > 500);
  FrontierLayer<2> anew(map.lattice());
  anew.rebuild(occupancy, &closed);
  REQUIRE(anew.cells() == frontier.cells());
}

TEST_CASE("What follows an empty map is empty", "[frontier]") {
  const Map<> map;
  Followers<TBayes> followers(map.lattice(), {});
  followers.follow(map);
  followers.require_same_as_all_anew(map);
  followers.rebuild(map);
  followers.require_same_as_all_anew(map);
  REQUIRE(followers.information_nats() == 0.0);
}

TEST_CASE("What follows a map finds out that it has missed scans, and lets go of what a map knew before", "[frontier]") {
  Random random(3);
  Map<> map({0.2, 0.5});
  Followers<TBayes> followers(map.lattice(), {});
  for (const int missed : {0, 1, 0, 4}) {
    for (int n = 0; n <= missed; ++n) {
      map.update(room_scan(random), {random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0), 0.0}, Eigen::Matrix3d::Zero());
    }
    followers.follow(map);
    followers.require_same_as_all_anew(map);
    followers.follow(map);  // nothing has changed since
    followers.require_same_as_all_anew(map);
  }
  OccupancyLayer occupancy(map.lattice());
  FrontierLayer frontier(map.lattice());
  occupancy.rebuild(map);
  frontier.follow(occupancy);
  REQUIRE(frontier.cells() == detect_frontier<2>(classify(map)));
  REQUIRE(frontier.cells().size() > 50);
  const Map<> other({0.2, 0.5});
  occupancy.rebuild(other);
  frontier.follow(occupancy);
  REQUIRE(frontier.cells().empty());
}
