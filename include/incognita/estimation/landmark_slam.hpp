/// A robot and landmarks located together by a linear Kalman filter (Sansoni et al., A.5).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/core/error.hpp"

namespace incognita {

/// One landmark as a robot sees it.
template <int Dim>
struct Sighting {
  int landmark = 0;                              ///< which one it is: association is known
  Eigen::Matrix<double, Dim, 1> relative_m;      ///< the landmark's place less the robot's, in the axes of the map: the heading is known
};

/// (A.16) and (A.17) with A = I: the robot's position and those of all landmarks seen so far have one Gaussian, which motion
/// and sightings change linearly, so that the covariance is consistent, and depends on what was seen but not on what was measured.
/// Landmarks join on first sight. For robots that know their heading, and for studies that linearisation must not blur. In the plane or
/// in space. Not thread safe.
template <int Dim>
class LandmarkSlam {
 public:
  using Vector = Eigen::Matrix<double, Dim, 1>;                                                    ///< a position or a way, in metres
  using Covariance = Eigen::Matrix<double, Dim, Dim>;                                              ///< in m^2, in the axes of the map
  using JointVector = Eigen::Matrix<typename Vector::Scalar, Eigen::Dynamic, 1>;                   ///< robot and landmarks, Dim entries each
  using JointCovariance = Eigen::Matrix<typename Vector::Scalar, Eigen::Dynamic, Eigen::Dynamic>;  ///< likewise, in m^2

  /// Variances along each axis, of independent errors.
  struct Params {
    double process_m2 = 0.01;      ///< Q = process_m2 I, a step, >= 0
    double measurement_m2 = 0.01;  ///< R = measurement_m2 I, > 0
    double initial_m2 = 0.01;      ///< P_0 = initial_m2 I, > 0
  };

  /// The robot starts at the origin. Throws std::invalid_argument for parameters outside of the bounds stated with them.
  explicit LandmarkSlam(const Params& params = {}) : params_(params) {
    require_non_negative("LandmarkSlam", "process_m2", params.process_m2);
    require_positive("LandmarkSlam", "measurement_m2", params.measurement_m2);
    require_positive("LandmarkSlam", "initial_m2", params.initial_m2);
    make_room(4 * Dim);
    covariance_.template topLeftCorner<Dim, Dim>() = params.initial_m2 * Covariance::Identity();
    mean_.template head<Dim>().setZero();
  }

  /// (A.16): the robot has moved by step_m, give or take Q. Throws std::invalid_argument for a step that is not finite. O(1).
  void move(const Vector& step_m) {
    for (int axis = 0; axis < Dim; ++axis) require(std::isfinite(step_m[axis]), "LandmarkSlam::move", "a step", step_m[axis], "finite");
    mean_.template head<Dim>() += step_m;
    covariance_.template topLeftCorner<Dim, Dim>().diagonal().array() += params_.process_m2;
  }

  /// (A.17) of all sightings of one scan. Throws std::invalid_argument, with nothing changed, for a sighting that is not finite, and
  /// when a landmark is seen twice or two are seen at one place (within 1 um): the association is wrong. O(sightings n^2) for n
  /// landmarks, amortised.
  void observe(std::span<const Sighting<Dim>> sightings) {
    validate(sightings);
    for (const Sighting<Dim>& sighting : sightings) {
      const auto known = std::find(landmarks_.begin(), landmarks_.end(), sighting.landmark);
      if (known == landmarks_.end()) {
        add(sighting);
      } else {
        correct(sighting, Dim * (1 + static_cast<Eigen::Index>(known - landmarks_.begin())));
      }
    }
  }

  [[nodiscard]] Vector position_m() const { return mean_.template head<Dim>(); }  ///< of the robot, in the map's frame
  [[nodiscard]] Covariance position_covariance_m2() const { return covariance_.template topLeftCorner<Dim, Dim>(); }  ///< of the robot

  /// The landmarks in the order in which they were first seen.
  [[nodiscard]] const std::vector<int>& landmarks() const { return landmarks_; }
  /// Of a landmark in the map's frame. Throws std::out_of_range where there is no such landmark.
  [[nodiscard]] Vector landmark_m(std::size_t index) const { return mean_.template segment<Dim>(start_of(index)); }
  /// Of a landmark. Throws std::out_of_range where there is no such landmark.
  [[nodiscard]] Covariance landmark_covariance_m2(std::size_t index) const {
    return covariance_.template block<Dim, Dim>(start_of(index), start_of(index));
  }

  /// Of the robot first, then the landmarks in order: symmetric to the bit and positive definite.
  [[nodiscard]] JointCovariance joint_covariance_m2() const { return covariance_.topLeftCorner(size(), size()); }

 private:
  [[nodiscard]] Eigen::Index size() const { return Dim * (1 + static_cast<Eigen::Index>(landmarks_.size())); }

  [[nodiscard]] Eigen::Index start_of(std::size_t index) const {
    if (index >= landmarks_.size()) {
      throw std::out_of_range("LandmarkSlam: the landmark's index is " + std::to_string(index) + ", but must be less than " +
                              std::to_string(landmarks_.size()) + ", the number of landmarks");
    }
    return Dim * (1 + static_cast<Eigen::Index>(index));
  }

  void validate(std::span<const Sighting<Dim>> sightings) const {
    constexpr double same_m = 1e-6;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const Sighting<Dim>& one = sightings[i];
      for (int axis = 0; axis < Dim; ++axis) {
        require(std::isfinite(one.relative_m[axis]), "LandmarkSlam::observe", "a sighting's coordinate", one.relative_m[axis], "finite");
      }
      for (std::size_t j = 0; j < i; ++j) {
        const Sighting<Dim>& other = sightings[j];
        const bool same_landmark = one.landmark == other.landmark;
        if (!same_landmark && (one.relative_m - other.relative_m).norm() > same_m) continue;
        std::ostringstream message;
        message << "LandmarkSlam::observe: landmark " << one.landmark << (same_landmark ? " is seen twice" : " is seen where landmark ");
        if (!same_landmark) message << other.landmark << " is";
        message << " in one scan, " << one.relative_m.transpose() << " m from the robot";
        throw std::invalid_argument(message.str());
      }
    }
  }

  /// A landmark on first sight: the robot's place and the measurement, both with their errors.
  void add(const Sighting<Dim>& sighting) {
    const Eigen::Index old = size();
    make_room(old + Dim);
    mean_.template segment<Dim>(old) = mean_.template head<Dim>() + sighting.relative_m;
    covariance_.block(old, 0, Dim, old) = covariance_.block(0, 0, Dim, old);
    covariance_.block(0, old, old, Dim) = covariance_.block(0, 0, old, Dim);
    covariance_.template block<Dim, Dim>(old, old) =
        covariance_.template topLeftCorner<Dim, Dim>() + params_.measurement_m2 * Covariance::Identity();
    landmarks_.push_back(sighting.landmark);
  }

  /// C = [-I, I] of the robot and the landmark that starts at `at`, the rest 0.
  void correct(const Sighting<Dim>& sighting, Eigen::Index at) {
    const Eigen::Index n = size();
    Eigen::Matrix<double, Eigen::Dynamic, Dim> gain = covariance_.block(0, at, n, Dim) - covariance_.block(0, 0, n, Dim);
    const Covariance innovation_m2 = gain.template middleRows<Dim>(at) - gain.template topRows<Dim>() +
                                     params_.measurement_m2 * Covariance::Identity();
    // Cholesky's factor L of the innovation's covariance; gain L^-T gain^T L^-1 is taken off by its square root.
    Covariance factor = Covariance::Zero();
    for (int row = 0; row < Dim; ++row) {
      for (int column = 0; column <= row; ++column) {
        double rest = innovation_m2(row, column);
        for (int k = 0; k < column; ++k) rest -= factor(row, k) * factor(column, k);
        factor(row, column) = row == column ? std::sqrt(rest) : rest / factor(column, column);
      }
    }
    Vector whitened = sighting.relative_m - (mean_.template segment<Dim>(at) - mean_.template head<Dim>());
    for (int column = 0; column < Dim; ++column) {
      for (int k = 0; k < column; ++k) {
        gain.col(column) -= factor(column, k) * gain.col(k);
        whitened[column] -= factor(column, k) * whitened[k];
      }
      gain.col(column) /= factor(column, column);
      whitened[column] /= factor(column, column);
    }
    mean_.head(n) += gain * whitened;
    for (Eigen::Index column = 0; column < n; ++column) {
      for (int k = 0; k < Dim; ++k) {
        covariance_.col(column).segment(column, n - column) -= gain(column, k) * gain.col(k).segment(column, n - column);
      }
      covariance_.row(column).segment(column, n - column) = covariance_.col(column).segment(column, n - column).transpose();
    }
  }

  void make_room(Eigen::Index needed) {
    const Eigen::Index room = mean_.size();
    if (needed <= room) return;
    const Eigen::Index more = std::max(needed, 2 * room);
    mean_.conservativeResize(more);
    covariance_.conservativeResize(more, more);
  }

  Params params_;
  JointVector mean_;            // of which size() are in use
  JointCovariance covariance_;  // likewise
  std::vector<int> landmarks_;
};

}  // namespace incognita
