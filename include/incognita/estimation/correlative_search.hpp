/// Where a scan fits the surfaces of a map best within a window of poses: for odometry errors beyond
/// registration's reach.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/angles.hpp"
#include "incognita/core/error.hpp"
#include "incognita/estimation/likelihood_grid.hpp"
#include "incognita/estimation/likelihood_pyramid.hpp"
#include "incognita/estimation/pose_belief.hpp"
#include "incognita/estimation/search_lattice.hpp"
#include "incognita/estimation/surface_map.hpp"
#include "incognita/geometry/pose.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// Parameters of CorrelativeSearch.
struct CorrelativeSearchParams {
  double step_m = 0.05;           ///< of the lattice of positions, and the cell of the likelihood
  double yaw_step_rad = 0.0;      ///< 0: end points move by step_m at most (step_m / longest hit, <= pi / 4)
  double sigma_m = 0.1;           ///< of the likelihood: two steps, so that no maximum falls between poses
  double prior_weight = 0.01;     ///< of a squared Mahalanobis distance, against a score in [0, 1]
  int candidates_max = 12;        ///< >= 1
  double separation_m = 0.3;      ///< two candidates are this far apart ...
  double separation_rad = 0.1;    ///< ... or turned this far: about as far as registration reaches
  double objective_margin = 0.2;  ///< candidates whose objective is this much below the best are left out; no unit

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("CorrelativeSearchParams", "step_m", step_m);
    require_non_negative("CorrelativeSearchParams", "yaw_step_rad", yaw_step_rad);
    require_positive("CorrelativeSearchParams", "sigma_m", sigma_m);
    require_non_negative("CorrelativeSearchParams", "prior_weight", prior_weight);
    require(candidates_max >= 1, "CorrelativeSearchParams", "candidates_max", candidates_max, ">= 1");
    require_non_negative("CorrelativeSearchParams", "separation_m", separation_m);
    require_non_negative("CorrelativeSearchParams", "separation_rad", separation_rad);
    require_non_negative("CorrelativeSearchParams", "objective_margin", objective_margin);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "step_m, yaw_step_rad, sigma_m, prior_weight, candidates_max, separation_m, separation_rad, objective_margin",
        step_m, yaw_step_rad, sigma_m, prior_weight, candidates_max, separation_m, separation_rad, objective_margin);
  }
};

/// A pose that a search found.
struct SearchCandidate {
  Pose2 pose;              ///< T_map_robot
  double score = 0.0;      ///< the mean likelihood of the hits' end points, in (0, 1]; no unit
  double objective = 0.0;  ///< the score less the prior's cost: what candidates are ranked by; no unit
};

/// An exact search by branch and bound. Over the poses of a SearchLattice the objective is the mean, over the
/// scan's hits, of the LikelihoodGrid's value in the cell where the hit ends, less prior_weight times
/// SearchPrior. A candidate is a pose whose 26 neighbours in the lattice are all worse; they are taken best
/// first, leaving out what is nearer to one taken before than both separations. Poses where no hit fits
/// anything do not count. The result is that of looking at every pose; of equal poses the one with the smallest
/// turn, then y, then x, is better. Surfaces are taken where they were measured, without the shifts of MapDrift.
///
/// Squares of positions are bounded by a LikelihoodPyramid and split best bound first (Hess et al., 2016,
/// section V); squares of 8 x 8 are scored whole. Scores are whole numbers, so the outcome is the same on
/// every machine that rounds the end points to the same cells.
///
/// Memory: 4 bytes a hit and turn; 8 bytes a cell of step_m within the longest hit of the window, 19 where the
/// window is wider than 16 steps; 24 bytes an open square or maximum, which are fewer than one in 7 poses. All
/// of it is kept for the next search, which allocates only to grow. One object is for one thread.
template <int Dim = 2>
class CorrelativeSearch {
  static_assert(Dim == 2, "searches are planar");

 public:
  using Params = CorrelativeSearchParams;  ///< so that the search's parameters go by one name

  /// Throws std::invalid_argument for bad parameters.
  explicit CorrelativeSearch(const Params& params = {}) : params_(params) { params.validate(); }

  [[nodiscard]] const Params& params() const { return params_; }  ///< as given

  /// The best candidates around a centre, best first, without a prior. None when the scan has no hits or none
  /// of them fits anything. Valid until the next search. Throws std::invalid_argument when the centre is not
  /// finite, for a bad window, and for one that is too large for its steps, with the range of the scan.
  const std::vector<SearchCandidate>& find(const Scan<Dim>& scan, const SurfaceMap<Dim>& surfaces,
                                           const Pose2& center, const SearchWindow& window) {
    return search(scan, surfaces, center, nullptr, window);
  }

  /// As above, with the belief as prior. Throws std::invalid_argument for a covariance that is none.
  const std::vector<SearchCandidate>& find(const Scan<Dim>& scan, const SurfaceMap<Dim>& surfaces,
                                           const PoseBelief& center, const SearchWindow& window) {
    require_belief("CorrelativeSearch", center);
    return search(scan, surfaces, center.pose, &center.covariance, window);
  }

 private:
  using At = SearchLattice::At;
  using Score = std::int64_t;  // in units of 1 / (hits * value_max)

  struct Hit {
    Point<Dim> end_m;
    double direction_rad;
  };
  /// Where a hit ends at the smallest offsets of a turn: its column and stacked row in the likelihood grid.
  struct Cell {
    std::uint16_t column;
    std::uint16_t row;
  };
  /// A square of 2^level poses a side, or, at level -1, a pose.
  struct Node {
    Score objective;
    At at;
    int level;
  };
  static constexpr int pose_level = -1;
  static constexpr int tile_level = 3;
  static constexpr int tile = 1 << tile_level;
  static constexpr int cells_max = 8192;  // of a side of the grid, so that a stacked row fits 16 bits

  const std::vector<SearchCandidate>& search(const Scan<Dim>& scan, const SurfaceMap<Dim>& surfaces,
                                             const Pose2& center, const Eigen::Matrix3d* covariance,
                                             const SearchWindow& window) {
    window.validate();
    require_finite_pose("CorrelativeSearch", "the center", center);
    candidates_.clear();
    taken_.clear();
    const double longest_m = collect_hits(scan);
    if (hits_.empty()) return candidates_;

    const double yaw_step_rad =
        params_.yaw_step_rad > 0.0 ? params_.yaw_step_rad : params_.step_m / longest_m;
    lattice_ = SearchLattice(center, window, params_.step_m, std::min(yaw_step_rad, 0.25 * std::numbers::pi));
    has_prior_ = covariance != nullptr && params_.prior_weight > 0.0;
    if (has_prior_) prior_ = SearchPrior(*covariance, lattice_);
    top_ = tile_level;
    while (top_ < LikelihoodPyramid<Dim>::level_max &&
           (2 << top_) < std::max(lattice_.size.x, lattice_.size.y)) {
      ++top_;
    }
    rasterise(surfaces, longest_m);
    place_hits();
    branch_and_bound();
    return candidates_;
  }

  /// Returns the longest range.
  double collect_hits(const Scan<Dim>& scan) {
    hits_.clear();
    double longest_m = 0.0;
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.reading(beam) != Reading::hit) continue;
      const Point<Dim>& direction = scan.direction(beam);
      hits_.push_back({scan.end_point_m(beam), std::atan2(direction[1], direction[0])});
      longest_m = std::max(longest_m, scan.range_m(beam));
    }
    return longest_m;
  }

  /// The likelihood wherever a hit may end, and its bounds.
  void rasterise(const SurfaceMap<Dim>& surfaces, double longest_m) {
    const double reach = std::ceil(longest_m / params_.step_m) + 1.0;
    const double cells = 2.0 * reach + std::max(lattice_.size.x, lattice_.size.y) + 2 * tile + (1 << top_);
    require(cells <= cells_max, "CorrelativeSearch", "cells across the window and the longest hit", cells,
            "<= 8192");
    reach_ = static_cast<int>(reach);
    // A tile may stick out of the window by all but one pose.
    const int columns = 2 * reach_ + lattice_.size.x + tile;
    const int multiple = LikelihoodPyramid<Dim>::row_multiple(top_);
    const int rows = (2 * reach_ + lattice_.size.y + tile + multiple - 1) / multiple * multiple;
    const Point<Dim> origin_m(lattice_.center.x_m - (reach_ + lattice_.half.x) * params_.step_m,
                              lattice_.center.y_m - (reach_ + lattice_.half.y) * params_.step_m);
    grid_.rebuild(surfaces, Lattice<Dim>(params_.step_m, origin_m), columns, rows, params_.sigma_m);
    if (top_ > tile_level) pyramid_.rebuild(grid_, top_);
  }

  void place_hits() {
    cells_.clear();
    cells_.reserve(hits_.size() * static_cast<std::size_t>(lattice_.size.turn));
    for (int turn = 0; turn < lattice_.size.turn; ++turn) {
      const double yaw_rad = lattice_.center.yaw_rad + lattice_.yaw_offset_rad(turn);
      const double c = std::cos(yaw_rad) / params_.step_m;
      const double s = std::sin(yaw_rad) / params_.step_m;
      for (const Hit& hit : hits_) {
        const int column = static_cast<int>(reach_ + (c * hit.end_m[0] - s * hit.end_m[1]));
        const int row = static_cast<int>(reach_ + (s * hit.end_m[0] + c * hit.end_m[1]));
        const int layer = LikelihoodGrid<Dim>::layer_of(hit.direction_rad + yaw_rad);
        cells_.push_back(
            {static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(layer * grid_.rows() + row)});
      }
    }
  }

  [[nodiscard]] const Cell* cells_of_turn(int turn) const {
    return cells_.data() + static_cast<std::size_t>(turn) * hits_.size();
  }

  /// No more than what the prior takes from each pose of a square; exact for a single pose.
  [[nodiscard]] Score prior_cost(const At& at, int side) const {
    if (!has_prior_) return 0;
    const double x_m = (at.x - lattice_.half.x) * params_.step_m;
    const double y_m = (at.y - lattice_.half.y) * params_.step_m;
    const double more_m = (side - 1) * params_.step_m;
    const double distance =
        prior_.distance_min(lattice_.yaw_offset_rad(at.turn), x_m, x_m + more_m, y_m, y_m + more_m);
    const double cost = params_.prior_weight * distance * static_cast<double>(score_max());
    // Rounding may differ between a square and its poses by less than a unit, and no cost may overflow.
    return static_cast<Score>(std::min(cost, 1e15)) - (side > 1 ? 1 : 0);
  }

  [[nodiscard]] Score score_max() const {
    return static_cast<Score>(hits_.size()) * LikelihoodGrid<Dim>::value_max;
  }

  [[nodiscard]] Score score_of(const At& at) const {
    const std::uint8_t* values =
        grid_.values().data() + static_cast<std::ptrdiff_t>(at.y) * grid_.columns() + at.x;
    const Cell* cells = cells_of_turn(at.turn);
    Score score = 0;
    for (std::size_t hit = 0; hit < hits_.size(); ++hit) {
      score += values[static_cast<std::ptrdiff_t>(cells[hit].row) * grid_.columns() + cells[hit].column];
    }
    return score;
  }

  [[nodiscard]] Score bound_of(const At& at, int level) const {
    if (top_ == tile_level) return score_max();
    const int shift = level - 2;
    const std::uint8_t* entries = pyramid_.entries(level);
    const std::ptrdiff_t columns = pyramid_.columns(level);
    const Cell* cells = cells_of_turn(at.turn);
    Score bound = 0;
    for (std::size_t hit = 0; hit < hits_.size(); ++hit) {
      bound += entries[((cells[hit].row + at.y) >> shift) * columns + ((cells[hit].column + at.x) >> shift)];
    }
    return bound;
  }

  /// The scores of 8 x 8 poses, x fastest.
  void score_tile(const At& at, std::array<Score, tile * tile>& scores) const {
    constexpr std::size_t hits_per_sum = 65535 / LikelihoodGrid<Dim>::value_max;
    const std::uint8_t* values =
        grid_.values().data() + static_cast<std::ptrdiff_t>(at.y) * grid_.columns() + at.x;
    const std::ptrdiff_t columns = grid_.columns();
    const Cell* cells = cells_of_turn(at.turn);
    scores.fill(0);
    for (std::size_t hit = 0; hit < hits_.size();) {
      std::array<std::uint16_t, tile * tile> sums{};
      for (const std::size_t end = std::min(hits_.size(), hit + hits_per_sum); hit < end; ++hit) {
        const std::uint8_t* row = values + cells[hit].row * columns + cells[hit].column;
        std::uint16_t* sum = sums.data();
        for (int y = 0; y < tile; ++y, row += columns, sum += tile) {
          for (int x = 0; x < tile; ++x) sum[x] = static_cast<std::uint16_t>(sum[x] + row[x]);
        }
      }
      for (std::size_t i = 0; i < scores.size(); ++i) scores[i] += sums[i];
    }
  }

  /// A total order on poses of the lattice.
  [[nodiscard]] static bool comes_before(const At& a, const At& b) {
    return a.turn != b.turn ? a.turn < b.turn : a.y != b.y ? a.y < b.y : a.x < b.x;
  }

  /// Heap order: the best objective on top; of equal ones squares, which may hold an equal pose that comes
  /// before.
  struct Worse {
    [[nodiscard]] bool operator()(const Node& a, const Node& b) const {
      if (a.objective != b.objective) return a.objective < b.objective;
      if (a.level != b.level) return a.level < b.level;
      return comes_before(b.at, a.at);
    }
  };

  void push(const Node& node) {
    nodes_.push_back(node);
    std::push_heap(nodes_.begin(), nodes_.end(), Worse{});
  }

  [[nodiscard]] Score objective_min() const { return best_ - margin_; }

  void push_square(const At& at, int level) {
    if (at.x >= lattice_.size.x || at.y >= lattice_.size.y) return;
    const Score bound = bound_of(at, level);
    const Score objective = bound - prior_cost(at, 1 << level);
    if (bound > 0 && objective >= objective_min()) push({objective, at, level});
  }

  void branch_and_bound() {
    best_ = std::numeric_limits<Score>::min() / 2;
    margin_ = static_cast<Score>(std::min(params_.objective_margin * static_cast<double>(score_max()), 1e15));
    nodes_.clear();
    for (int turn = 0; turn < lattice_.size.turn; ++turn) {
      for (int y = 0; y < lattice_.size.y; y += 1 << top_) {
        for (int x = 0; x < lattice_.size.x; x += 1 << top_) push_square({x, y, turn}, top_);
      }
    }
    while (!nodes_.empty() && nodes_.front().objective >= objective_min()) {
      const Node node = nodes_.front();
      std::pop_heap(nodes_.begin(), nodes_.end(), Worse{});
      nodes_.pop_back();
      if (node.level == pose_level) {
        if (is_near_taken(node.at)) continue;
        take(node);
        if (static_cast<int>(candidates_.size()) == params_.candidates_max) return;
      } else if (node.level == tile_level) {
        push_maxima(node.at);
      } else {
        const int half = 1 << (node.level - 1);
        for (int child = 0; child < 4; ++child) {
          push_square({node.at.x + (child & 1) * half, node.at.y + (child >> 1) * half, node.at.turn},
                      node.level - 1);
        }
      }
    }
  }

  /// Scores a tile and pushes its poses that are better than all of their neighbours.
  void push_maxima(const At& corner) {
    constexpr Score outside = std::numeric_limits<Score>::min();
    std::array<Score, tile * tile> scores;
    score_tile(corner, scores);
    const Score cost_min = prior_cost(corner, tile);
    std::array<Score, tile * tile> objectives;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const At at = at_in_tile(corner, i);
      objectives[i] = outside;
      if (scores[i] == 0 || scores[i] - cost_min < objective_min() || at.x >= lattice_.size.x ||
          at.y >= lattice_.size.y) {
        continue;
      }
      objectives[i] = scores[i] - prior_cost(at, 1);
      best_ = std::max(best_, objectives[i]);
    }
    for (std::size_t i = 0; i < scores.size(); ++i) {
      if (objectives[i] == outside || objectives[i] < objective_min()) continue;
      const int x = static_cast<int>(i) % tile;
      const int y = static_cast<int>(i) / tile;
      bool is_maximum = true;
      for (int n = 0; n < 9 && is_maximum; ++n) {
        const int other_x = x + n % 3 - 1;
        const int other_y = y + n / 3 - 1;
        if (n == 4 || other_x < 0 || other_x >= tile || other_y < 0 || other_y >= tile) continue;
        const Score other = objectives[static_cast<std::size_t>(other_y * tile + other_x)];
        is_maximum = n < 4 ? other < objectives[i] : other <= objectives[i];
      }
      if (is_maximum && is_maximum_beyond_tile(corner, x, y, objectives[i])) {
        push({objectives[i], at_in_tile(corner, i), pose_level});
      }
    }
  }

  [[nodiscard]] static At at_in_tile(const At& corner, std::size_t i) {
    return {corner.x + static_cast<int>(i) % tile, corner.y + static_cast<int>(i) / tile, corner.turn};
  }

  /// Compares a pose with its neighbours in the window that are not in its tile. Those that it would lose to
  /// most often come first: a turn on.
  [[nodiscard]] bool is_maximum_beyond_tile(const At& corner, int x, int y, Score objective) const {
    const At at{corner.x + x, corner.y + y, corner.turn};
    for (const int dturn : {-1, 1, 0}) {
      At other{0, 0, at.turn + dturn};
      if (lattice_.is_circle) other.turn = (other.turn + lattice_.size.turn) % lattice_.size.turn;
      if (other.turn < 0 || other.turn >= lattice_.size.turn || (dturn != 0 && other.turn == at.turn))
        continue;
      for (const int n : {4, 1, 3, 5, 7, 0, 2, 6, 8}) {
        const int other_x = x + n % 3 - 1;
        const int other_y = y + n / 3 - 1;
        if (dturn == 0 && other_x >= 0 && other_x < tile && other_y >= 0 && other_y < tile) continue;
        other.x = corner.x + other_x;
        other.y = corner.y + other_y;
        if (other.x < 0 || other.x >= lattice_.size.x || other.y < 0 || other.y >= lattice_.size.y) continue;
        const Score score = score_of(other);
        if (score == 0) continue;
        const Score other_objective = score - prior_cost(other, 1);
        if (other_objective > objective || (other_objective == objective && comes_before(other, at)))
          return false;
      }
    }
    return true;
  }

  [[nodiscard]] bool is_near_taken(const At& at) const {
    constexpr double slack = 1e-9;  // a separation that is a multiple of the step counts as kept
    const double apart = params_.separation_m / params_.step_m;
    for (const At& other : taken_) {
      const double squared =
          static_cast<double>((at.x - other.x) * (at.x - other.x) + (at.y - other.y) * (at.y - other.y));
      const double turned_rad = lattice_.turns_between(at.turn, other.turn) * lattice_.yaw_step_rad;
      if (squared < apart * apart * (1.0 - slack) && turned_rad < params_.separation_rad * (1.0 - slack))
        return true;
    }
    return false;
  }

  void take(const Node& node) {
    taken_.push_back(node.at);
    const double unit = 1.0 / static_cast<double>(score_max());
    candidates_.push_back({lattice_.pose(node.at), static_cast<double>(score_of(node.at)) * unit,
                           static_cast<double>(node.objective) * unit});
  }

  Params params_;
  SearchLattice lattice_{{}, {}, 1.0, 1.0};
  SearchPrior prior_;
  bool has_prior_ = false;
  int top_ = tile_level;
  int reach_ = 0;
  Score best_ = 0;
  Score margin_ = 0;
  std::vector<Hit> hits_;
  std::vector<Cell> cells_;
  LikelihoodGrid<Dim> grid_;
  LikelihoodPyramid<Dim> pyramid_;
  std::vector<Node> nodes_;
  std::vector<At> taken_;
  std::vector<SearchCandidate> candidates_;
};

}  // namespace incognita
