#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "../estimation/room.hpp"
#include "incognita/core/random.hpp"
#include "incognita/loops/drift_graph.hpp"

using namespace incognita;

namespace {

struct Measured {
  int from;
  int to;
  Eigen::Matrix3d information;
  Eigen::Vector3d mean;
};

Eigen::Vector3d random_twist(Random& random) {
  return {random.normal(0.0, 0.1), random.normal(0.0, 0.1), random.normal(0.0, 0.01)};
}

DriftGraph graph_of(int bodies, const std::vector<Measured>& links) {
  DriftGraph graph;
  for (int body = 0; body < bodies; ++body) CHECK(graph.add_body() == body);
  for (const Measured& link : links) graph.add_link(link.from, link.to, link.information, link.information * link.mean);
  return graph;
}

/// Half of the cost's gradient by each body's twist, from the cost's definition.
std::vector<Eigen::Vector3d> gradient(const std::vector<Eigen::Vector3d>& twists, const std::vector<Measured>& links) {
  std::vector<Eigen::Vector3d> result(twists.size(), Eigen::Vector3d::Zero());
  for (const Measured& link : links) {
    const Eigen::Vector3d apart = twists[static_cast<std::size_t>(link.to)] - twists[static_cast<std::size_t>(link.from)];
    const Eigen::Vector3d pull = link.information * (apart - link.mean);
    result[static_cast<std::size_t>(link.to)] += pull;
    result[static_cast<std::size_t>(link.from)] -= pull;
  }
  return result;
}

}  // namespace

TEST_CASE("A graph's solution leaves no body a way to cost less", "[loops]") {
  Random random(1);
  for (int draw = 0; draw < 30; ++draw) {
    const int bodies = 2 + static_cast<int>(random.uniform(0.0, 40.0));
    std::vector<Measured> links;
    for (int to = 1; to < bodies; ++to) {
      const Eigen::Matrix3d information = room::random_covariance(random, 100.0) + Eigen::Matrix3d::Identity();
      links.push_back({to - 1, to, information, random_twist(random)});
    }
    for (int extra = 0; extra < bodies; ++extra) {
      const int from = static_cast<int>(random.uniform(0.0, bodies));
      const int to = static_cast<int>(random.uniform(0.0, bodies));
      if (from == to) continue;
      // A wall says nothing along itself: information of rank one.
      const Eigen::Vector3d across = random_twist(random);
      links.push_back({from, to, 1e4 * across * across.transpose(), random_twist(random)});
    }
    const std::vector<Eigen::Vector3d> twists = graph_of(bodies, links).solve();
    REQUIRE(twists.size() == static_cast<std::size_t>(bodies));
    CHECK(twists[0].norm() == 0.0);
    const auto left = gradient(twists, links);
    for (std::size_t body = 1; body < left.size(); ++body) REQUIRE(left[body].norm() < 1e-6);
  }
}

TEST_CASE("What a chain is off when it closes is shared by the covariances of its links", "[loops]") {
  Random random(2);
  for (int draw = 0; draw < 20; ++draw) {
    const int bodies = 12;
    std::vector<Measured> links;
    std::vector<Eigen::Matrix3d> covariances;
    Eigen::Matrix3d total = room::random_covariance(random, 0.01);
    const Eigen::Vector3d off = random_twist(random);
    links.push_back({0, bodies - 1, total.inverse(), off});
    for (int to = 1; to < bodies; ++to) {
      covariances.push_back(room::random_covariance(random, 0.01));
      total += covariances.back();
      links.push_back({to - 1, to, covariances.back().inverse(), Eigen::Vector3d::Zero()});
    }
    const auto twists = graph_of(bodies, links).solve();
    Eigen::Matrix3d so_far = Eigen::Matrix3d::Zero();
    for (int body = 1; body < bodies; ++body) {
      so_far += covariances[static_cast<std::size_t>(body - 1)];
      const Eigen::Vector3d expected = so_far * total.ldlt().solve(off);
      REQUIRE((twists[static_cast<std::size_t>(body)] - expected).norm() < 1e-6 * off.norm());
    }
  }
}

TEST_CASE("A graph of the frame alone has a solution", "[loops]") {
  DriftGraph graph;
  CHECK(graph.solve().empty());
  graph.add_body();
  CHECK(graph.solve().size() == 1);
}

TEST_CASE("A graph that leaves a body free is refused", "[loops]") {
  DriftGraph graph;
  for (int body = 0; body < 3; ++body) graph.add_body();
  graph.add_link(0, 1, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  CHECK_THROWS_WITH(graph.solve(), Catch::Contains("1 links") && Catch::Contains("3 bodies"));
  graph.add_link(1, 2, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Ones());
  CHECK((graph.solve()[2] - Eigen::Vector3d::Ones()).norm() < 1e-12);
}

TEST_CASE("A link between bodies that are not there is refused", "[loops]") {
  DriftGraph graph;
  graph.add_body();
  graph.add_body();
  const Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  CHECK_THROWS_WITH(graph.add_link(-1, 1, information, vector), Catch::Contains("from") && Catch::Contains("-1"));
  CHECK_THROWS_WITH(graph.add_link(0, 2, information, vector), Catch::Contains("to") && Catch::Contains("2"));
  CHECK_THROWS_AS(graph.add_link(1, 1, information, vector), std::invalid_argument);
  CHECK(graph.links() == 0);
}
