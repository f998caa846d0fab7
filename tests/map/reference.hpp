/// A slow map to compare with: cells in a std::map, arithmetic in double, a walk that sorts all crossings.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/geometry/pose3.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/sensor/scan.hpp"

namespace reference {

using incognita::LogOdds;
using incognita::Point;
using incognita::Pose;
using incognita::Pose2;
using incognita::Pose3;
using incognita::Random;
using incognita::Reading;
using incognita::Scan;
using incognita::TBayes;

template <int Dim>
using Key = std::array<int, static_cast<std::size_t>(Dim)>;

/// The cells whose interior a segment crosses, by all its crossings of lattice planes at once.
template <int Dim>
std::vector<Key<Dim>> cells_on(const Point<Dim>& from, const Point<Dim>& to, double resolution_m) {
  std::vector<long double> crossings{0.0L, 1.0L};
  for (int axis = 0; axis < Dim; ++axis) {
    const long double a = static_cast<long double>(from[axis]) / resolution_m;
    const long double b = static_cast<long double>(to[axis]) / resolution_m;
    for (long double plane = std::ceil(std::min(a, b)); plane <= std::max(a, b); plane += 1.0L) {
      if (a != b) crossings.push_back((plane - a) / (b - a));
    }
  }
  std::sort(crossings.begin(), crossings.end());
  std::vector<Key<Dim>> cells;
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    if (crossings[i] - crossings[i - 1] < 1e-15L) continue;
    const long double middle = 0.5L * (crossings[i] + crossings[i - 1]);
    Key<Dim> key;
    for (int axis = 0; axis < Dim; ++axis) {
      const long double at =
          static_cast<long double>(from[axis]) +
          middle * (static_cast<long double>(to[axis]) - static_cast<long double>(from[axis]));
      key[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(at / resolution_m));
    }
    if (cells.empty() || cells.back() != key) cells.push_back(key);
  }
  return cells;
}

struct Cell {
  double log_odds = 0.0;
  int hits = 0;
  bool hit_now = false;
  bool eroded_now = false;
};

/// The T-Bayes cell as the reading words it.
struct TBayesRule {
  TBayes::Params params;

  [[nodiscard]] double dl(const Cell& cell, double residual_m, double variance_m2) const {
    const auto log_density = [&](double dvl_m2) {
      const double s = variance_m2 + dvl_m2;
      return -std::log(std::sqrt(2.0 * std::numbers::pi * s)) - residual_m * residual_m / (2.0 * s);
    };
    const double n = static_cast<double>(cell.hits) / params.hits_max;
    return (1.0 - n) * log_density(params.dvl.occupied_m2) - n * log_density(params.dvl.unoccupied_m2);
  }
  [[nodiscard]] double clamped(double log_odds) const {
    return std::clamp(log_odds, static_cast<double>(params.log_odds_min),
                      static_cast<double>(params.log_odds_max));
  }
  void hit(Cell& cell, double residual_m, double variance_m2) const {
    cell.hits = std::min(cell.hits + 1, params.hits_max);
    cell.hit_now = true;
    cell.log_odds = clamped(cell.log_odds + dl(cell, residual_m, variance_m2));
  }
  void pass(Cell& cell, double residual_m, double variance_m2) const {
    const double step = dl(cell, residual_m, variance_m2);
    if (params.rule == TBayes::Rule::literal) {
      cell.log_odds += step;
    } else if (cell.hits < params.hits_max) {
      if (step < 0.0) cell.log_odds = clamped(cell.log_odds + step);
    } else if (!cell.hit_now && !cell.eroded_now && residual_m > 0.6 &&
               residual_m > 3.0 * std::sqrt(variance_m2)) {
      cell.eroded_now = true;
      cell.log_odds -= 0.4;
      if (cell.log_odds < 0.0) cell.hits = 0;
    }
  }
};

struct LogOddsRule {
  LogOdds::Params params;
  void hit(Cell& cell, double, double) const {
    cell.hit_now = true;
    cell.log_odds = std::min(10.0, cell.log_odds + 0.85);
  }
  void pass(Cell& cell, double, double) const {
    if (!cell.hit_now || !params.hits_win) cell.log_odds = std::max(-10.0, cell.log_odds - 0.4);
  }
};

inline TBayesRule rule_of(const TBayes& policy) { return {policy.params()}; }
inline LogOddsRule rule_of(const LogOdds& policy) { return {policy.params()}; }

template <class Rule, int Dim>
struct SlowMap {
  Rule rule;
  double resolution_m;
  double push_m;
  std::map<Key<Dim>, Cell> cells{};

  void update(const Scan<Dim>& scan, const Pose<Dim>& T_map_sensor,
              const typename Pose<Dim>::Covariance& covariance) {
    for (auto& [key, cell] : cells) cell.hit_now = cell.eroded_now = false;
    const Point<Dim> origin = T_map_sensor.position();
    for (const bool hits : {true, false}) {
      for (std::size_t beam = 0; beam < scan.size(); ++beam) {
        const double z_m = scan.range_m(beam);
        if (!(z_m > 0.0 && z_m <= scan.range_max_m())) continue;
        const bool meets = z_m < scan.range_max_m();
        if (hits && !meets) continue;
        const Point<Dim> direction = T_map_sensor * scan.direction(beam) - origin;
        const double variance_m2 = direction.dot(covariance.template topLeftCorner<Dim, Dim>() * direction) /
                                   direction.squaredNorm();
        const double pushed_m = meets ? z_m + push_m : z_m;
        const Point<Dim> end = origin + direction * pushed_m;
        std::vector<Key<Dim>> walk = cells_on<Dim>(origin, end, resolution_m);
        const auto residual_m = [&](const Key<Dim>& key, double range_m) {
          Point<Dim> center;
          for (int axis = 0; axis < Dim; ++axis) {
            center[axis] = (key[static_cast<std::size_t>(axis)] + 0.5) * resolution_m;
          }
          return range_m - (center - origin).norm();
        };
        if (hits) {
          rule.hit(cells[walk.back()], residual_m(walk.back(), pushed_m), variance_m2);
          continue;
        }
        if (meets) walk.pop_back();
        for (const Key<Dim>& key : walk) rule.pass(cells[key], residual_m(key, z_m), variance_m2);
      }
    }
  }
};

inline Pose2 random_pose(Random& random, Pose2*) {
  return {random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0), random.uniform(-3.2, 3.2)};
}

inline Pose3 random_pose(Random& random, Pose3*) {
  Pose3 pose;
  pose.position_m = {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
  const Eigen::Vector4d q(random.normal(), random.normal(), random.normal(), random.normal());
  pose.orientation = Eigen::Quaterniond(q.normalized());
  return pose;
}

template <int Dim>
Pose<Dim> random_pose(Random& random) {
  return random_pose(random, static_cast<Pose<Dim>*>(nullptr));
}

template <int Dim>
typename Pose<Dim>::Covariance random_covariance(Random& random) {
  using Covariance = typename Pose<Dim>::Covariance;
  Covariance root;
  for (Eigen::Index entry = 0; entry < root.size(); ++entry) root(entry) = random.normal();
  const double sigma = std::pow(10.0, random.uniform(-3.0, -0.3));
  return sigma * sigma * root * root.transpose();
}

/// Beams in random directions; hits, clear beams and, where asked for, readings that are to be ignored.
template <int Dim>
Scan<Dim> random_scan(Random& random, std::size_t beams, double range_max_m, double bad_share = 0.0) {
  incognita::BeamPattern<Dim> pattern;
  pattern.range_max_m = range_max_m;
  for (std::size_t beam = 0; beam < beams; ++beam) {
    Point<Dim> direction;
    for (int axis = 0; axis < Dim; ++axis) direction[axis] = random.normal();
    pattern.directions.push_back(direction.normalized());
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::array<double, 7> bad_m{
      std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, -1.0, 0.0, range_max_m + 1e-9, 1e300};
  Scan<Dim> scan(pattern);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    if (random.uniform() < bad_share) {
      scan.set_range_m(beam, bad_m[random.index(bad_m.size())]);
    } else if (random.uniform() < 0.7) {
      scan.set_range_m(beam, random.uniform(0.05, range_max_m));
    }
  }
  return scan;
}

}  // namespace reference
