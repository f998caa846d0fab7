#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/estimation/landmark_slam.hpp"

using namespace incognita;
using Catch::Matchers::Contains;

namespace {

/// A textbook filter with dense matrices over a fixed number of landmarks, of which those not yet seen have a prior so wide
/// that the first sighting replaces it.
template <int Dim>
struct DenseFilter {
  static constexpr double kUnknown_m2 = 1e8;
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  double process_m2;
  double measurement_m2;

  DenseFilter(int landmarks, const typename LandmarkSlam<Dim>::Params& params)
      : process_m2(params.process_m2), measurement_m2(params.measurement_m2) {
    const int size = Dim * (1 + landmarks);
    mean = Eigen::VectorXd::Zero(size);
    covariance = kUnknown_m2 * Eigen::MatrixXd::Identity(size, size);
    covariance.topLeftCorner<Dim, Dim>() = params.initial_m2 * Eigen::Matrix<double, Dim, Dim>::Identity();
  }
  void move(const Eigen::Matrix<double, Dim, 1>& step_m) {
    mean.template head<Dim>() += step_m;
    covariance.topLeftCorner<Dim, Dim>() += process_m2 * Eigen::Matrix<double, Dim, Dim>::Identity();
  }
  /// All sightings at once, Joseph's form.
  void observe(const std::vector<Sighting<Dim>>& sightings) {
    const auto rows = Dim * static_cast<Eigen::Index>(sightings.size());
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(rows, mean.size());
    Eigen::VectorXd z(rows);
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const auto row = Dim * static_cast<Eigen::Index>(i);
      c.block<Dim, Dim>(row, 0) = -Eigen::Matrix<double, Dim, Dim>::Identity();
      c.block<Dim, Dim>(row, Dim * (1 + sightings[i].landmark)).setIdentity();
      z.segment<Dim>(row) = sightings[i].relative_m;
    }
    const Eigen::MatrixXd noise = measurement_m2 * Eigen::MatrixXd::Identity(rows, rows);
    const Eigen::MatrixXd gain = covariance * c.transpose() * (c * covariance * c.transpose() + noise).inverse();
    mean += gain * (z - c * mean);
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(mean.size(), mean.size()) - gain * c;
    covariance = rest * covariance * rest.transpose() + gain * noise * gain.transpose();
  }
};

template <int Dim>
Eigen::Matrix<double, Dim, 1> random_vector(Random& random, double reach) {
  Eigen::Matrix<double, Dim, 1> vector;
  for (int axis = 0; axis < Dim; ++axis) vector[axis] = random.uniform(-reach, reach);
  return vector;
}

template <int Dim>
void compare_with_dense(std::uint64_t seed) {
  Random random(seed);
  constexpr int kLandmarks = 9;
  const typename LandmarkSlam<Dim>::Params params{0.02, 0.05, 0.03};
  LandmarkSlam<Dim> slam(params);
  DenseFilter<Dim> dense(kLandmarks, params);
  for (int step = 0; step < 40; ++step) {
    const auto motion = random_vector<Dim>(random, 1.0);
    slam.move(motion);
    dense.move(motion);
    std::vector<Sighting<Dim>> sightings;
    for (int landmark = 0; landmark < kLandmarks; ++landmark) {
      if (random.uniform() < 0.3) sightings.push_back({landmark, random_vector<Dim>(random, 5.0)});
    }
    slam.observe(sightings);
    if (!sightings.empty()) dense.observe(sightings);
    REQUIRE((slam.position_m() - dense.mean.template head<Dim>()).norm() < 1e-5);
    REQUIRE((slam.position_covariance_m2() - dense.covariance.template topLeftCorner<Dim, Dim>()).norm() < 1e-5);
    for (std::size_t i = 0; i < slam.landmarks().size(); ++i) {
      const Eigen::Index at = Dim * (1 + slam.landmarks()[i]);
      REQUIRE((slam.landmark_m(i) - dense.mean.template segment<Dim>(at)).norm() < 1e-5);
      REQUIRE((slam.landmark_covariance_m2(i) - dense.covariance.template block<Dim, Dim>(at, at)).norm() < 1e-5);
    }
  }
  REQUIRE(slam.landmarks().size() == kLandmarks);
}

}  // namespace

TEST_CASE("Landmark SLAM is the textbook's filter, landmark by landmark", "[estimation]") {
  compare_with_dense<2>(1);
  compare_with_dense<3>(2);
}

TEST_CASE("The joint covariance stays symmetric and positive definite", "[estimation]") {
  Random random(3);
  LandmarkSlam<2> slam({0.01, 1e-6, 0.01});
  for (int step = 0; step < 5000; ++step) {
    slam.move(random_vector<2>(random, 0.3));
    std::vector<Sighting<2>> sightings;
    for (int landmark = 0; landmark < 20; ++landmark) {
      if (random.uniform() < 0.2) sightings.push_back({landmark, random_vector<2>(random, 5.0)});
    }
    slam.observe(sightings);
    if (step % 100 != 0) continue;
    const Eigen::MatrixXd joint = slam.joint_covariance_m2();
    REQUIRE(joint == joint.transpose());
    REQUIRE(Eigen::LLT<Eigen::MatrixXd>(joint).info() == Eigen::Success);
  }
}

TEST_CASE("Covariances tell of the errors there are", "[estimation]") {
  Random random(4);
  const std::vector<Eigen::Vector2d> landmarks{{3.0, 0.0}, {0.0, 4.0}, {-3.0, -2.0}, {8.0, 5.0}};
  double nees = 0.0;
  constexpr int kRuns = 300;
  for (int run = 0; run < kRuns; ++run) {
    LandmarkSlam<2> slam;
    Eigen::Vector2d truth(0.1 * random.normal(), 0.1 * random.normal());
    for (int step = 0; step < 30; ++step) {
      const Eigen::Vector2d motion(0.5 * std::cos(0.2 * step), 0.5 * std::sin(0.2 * step));
      slam.move(motion);
      truth += motion + 0.1 * Eigen::Vector2d(random.normal(), random.normal());
      std::vector<Sighting<2>> sightings;
      for (int landmark = 0; landmark < 4; ++landmark) {
        const Eigen::Vector2d away = landmarks[static_cast<std::size_t>(landmark)] - truth;
        if (away.norm() < 5.0) sightings.push_back({landmark, away + 0.1 * Eigen::Vector2d(random.normal(), random.normal())});
      }
      slam.observe(sightings);
    }
    const Eigen::Vector2d error = slam.position_m() - truth;
    nees += error.dot(slam.position_covariance_m2().inverse() * error) / kRuns;
  }
  REQUIRE(nees == Approx(2.0).margin(0.4));  // 3.5 sigma of a mean of 300
}

TEST_CASE("What cannot be is refused, and changes nothing", "[estimation]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  LandmarkSlam<2> slam;
  slam.observe(std::vector<Sighting<2>>{{7, {1.0, 2.0}}});
  const Eigen::MatrixXd before = slam.joint_covariance_m2();
  const auto observe = [&](std::vector<Sighting<2>> sightings) { slam.observe(sightings); };
  REQUIRE_THROWS_WITH(observe({{7, {1.0, 2.0}}, {8, {1.0, 2.0}}}), Contains("landmark 8 is seen where landmark 7 is in one scan"));
  REQUIRE_THROWS_WITH(observe({{7, {1.0, 2.0}}, {7, {1.5, 2.0}}}), Contains("landmark 7 is seen twice"));
  REQUIRE_THROWS_WITH(observe({{7, {1.0, 2.0}}, {9, {kNan, 2.0}}}), Contains("coordinate is nan"));
  REQUIRE_THROWS_WITH(slam.move({kNan, 0.0}), Contains("a step is nan"));
  REQUIRE(slam.joint_covariance_m2() == before);
  REQUIRE(slam.landmarks() == std::vector<int>{7});
  REQUIRE_THROWS_AS(slam.landmark_m(1), std::out_of_range);
  REQUIRE_THROWS_WITH(LandmarkSlam<2>({-1.0, 0.01, 0.01}), Contains("process_m2 is -1"));
  REQUIRE_THROWS_WITH(LandmarkSlam<2>({0.01, 0.0, 0.01}), Contains("measurement_m2 is 0"));
  REQUIRE_THROWS_WITH(LandmarkSlam<2>({0.01, 0.01, kNan}), Contains("initial_m2 is nan"));
}
