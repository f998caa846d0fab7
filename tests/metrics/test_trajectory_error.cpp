#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/metrics/trajectory_error.hpp"

namespace {

using namespace incognita;

double squared_distance_m2(const std::vector<Pose2>& estimated, const std::vector<Pose2>& truth,
                           const Pose2& T_true_estimated) {
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    sum += (T_true_estimated * estimated[i].position() - truth[i].position()).squaredNorm();
  }
  return sum;
}

}  // namespace

TEST_CASE("Errors of a trajectory worked out by hand", "[metrics]") {
  TrajectoryError error;
  CHECK(error.translation_rmse_m() == 0.0);
  CHECK(error.translation_mae_m() == 0.0);
  CHECK(error.heading_rmse_rad() == 0.0);
  error.add({1.0, 2.0, 0.1}, {1.0, 2.0, 0.1});
  error.add({4.0, 6.0, 3.1}, {1.0, 2.0, -3.1});  // 5 m, and across the end of the circle
  CHECK(error.count() == 2);
  CHECK(error.translation_rmse_m() == Approx(std::sqrt(12.5)));
  CHECK(error.translation_mae_m() == Approx(2.5));
  CHECK(error.translation_max_m() == Approx(5.0));
  CHECK(error.heading_rmse_rad() == Approx((2.0 * std::numbers::pi - 6.2) / std::sqrt(2.0)));
}

TEST_CASE("Whole trajectories give what their poses add up to", "[metrics]") {
  const std::vector<Pose2> estimated{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.5}, {2.0, 1.0, 1.0}};
  const std::vector<Pose2> truth{{0.0, 0.3, 0.0}, {1.4, 0.0, 0.5}, {2.0, 1.0, 1.2}};
  const TrajectoryError error = trajectory_error(estimated, truth);
  CHECK(error.translation_rmse_m() == Approx(std::sqrt((0.09 + 0.16) / 3.0)));
  CHECK(error.translation_mae_m() == Approx(0.7 / 3.0));
  CHECK(error.heading_rmse_rad() == Approx(0.2 / std::sqrt(3.0)));
  CHECK_THROWS_AS(trajectory_error(estimated, std::vector<Pose2>(2)), std::invalid_argument);
}

TEST_CASE("Alignment finds the motion between two copies of a trajectory", "[metrics]") {
  Random random(1);
  for (const double yaw_rad : {0.0, 0.3, -2.0, std::numbers::pi}) {
    const Pose2 T_true_estimated{random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), yaw_rad};
    std::vector<Pose2> estimated;
    std::vector<Pose2> truth;
    for (int i = 0; i < 40; ++i) {
      estimated.push_back({random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0), random.uniform(-3.0, 3.0)});
      truth.push_back(T_true_estimated * estimated.back());
    }
    const Pose2 found = align_rigidly(estimated, truth);
    CHECK(found.x_m == Approx(T_true_estimated.x_m).margin(1e-9));
    CHECK(found.y_m == Approx(T_true_estimated.y_m).margin(1e-9));
    CHECK(angle_between_rad(found.yaw_rad, yaw_rad) == Approx(0.0).margin(1e-12));
  }
}

TEST_CASE("No small motion aligns noisy trajectories better", "[metrics]") {
  Random random(2);
  std::vector<Pose2> estimated;
  std::vector<Pose2> truth;
  for (int i = 0; i < 60; ++i) {
    estimated.push_back({random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), 0.0});
    truth.push_back(Pose2{2.0, -1.0, 1.1} * estimated.back());
    truth.back().x_m += random.normal(0.0, 0.5);
    truth.back().y_m += random.normal(0.0, 0.5);
  }
  const Pose2 found = align_rigidly(estimated, truth);
  const double best_m2 = squared_distance_m2(estimated, truth, found);
  for (int i = 0; i < 200; ++i) {
    const Pose2 other{found.x_m + random.normal(0.0, 0.01), found.y_m + random.normal(0.0, 0.01),
                      found.yaw_rad + random.normal(0.0, 0.01)};
    CHECK(squared_distance_m2(estimated, truth, other) > best_m2);
  }
}

TEST_CASE("Alignment of very little", "[metrics]") {
  const std::vector<Pose2> one{{1.0, 2.0, 0.3}};
  const std::vector<Pose2> other{{-3.0, 5.0, 0.0}};
  const Pose2 found = align_rigidly(one, other);
  CHECK(found.x_m == Approx(-4.0));
  CHECK(found.y_m == Approx(3.0));
  CHECK(found.yaw_rad == 0.0);
  CHECK_THROWS_AS(align_rigidly({}, {}), std::invalid_argument);
  CHECK_THROWS_AS(align_rigidly(one, {}), std::invalid_argument);
}
