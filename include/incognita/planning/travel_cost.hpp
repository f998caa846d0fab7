/// What it costs a disc-shaped robot to travel from where it is to every cell of a belief.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/geometry/box.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/grid/components.hpp"
#include "incognita/map/occupancy.hpp"

namespace incognita {

/// Where a disc-shaped robot can travel and what it likes. Costs are in metres: a metre far from all walls
/// costs 1.
struct TravelParams {
  double robot_radius_m = 0.2;  ///< >= 0
  /// The robot's centre stays robot_radius_m + margin_m away from the centres of occupied cells. It is small
  /// on purpose: a larger one closes doors that the robot fits through, and the soft cost keeps it in the
  /// middle of them.
  double margin_m = 0.02;
  double clearance_soft_m =
      0.6;  ///< under this clearance c a metre costs 1 + clearance_weight (1 - c / this)^2
  double clearance_weight = 10.0;   ///< >= 0
  double escape_radius_m = 0.6;     ///< how far a robot may drive where it cannot be, to get to where it can
  double escape_cost_per_m = 20.0;  ///< of driving there, > 1 + clearance_weight

  /// What no path's end lacks.
  [[nodiscard]] double clearance_hard_m() const { return robot_radius_m + margin_m; }

  /// With this much, but less than clearance_hard_m, a cell may be passed where there is no better way, though no path
  /// ends there: the centre of an occupied cell lies up to half a diagonal before the surface that was measured in it, so
  /// a belief closes doors that the robot fits through. Whether it does fit is for the laser to say (see guard_command).
  /// At least half a cell: where there is no clearance at all, nothing passes.
  [[nodiscard]] double clearance_tight_m(double resolution_m) const {
    return std::max(0.5 * resolution_m, robot_radius_m - 0.5 * std::numbers::sqrt2 * resolution_m);
  }

  /// With this much or more the way has room. Between clearance_hard_m and this a belief whose walls are a cell off may call
  /// wide enough what is not, so that a robot that does not get through learns from it.
  [[nodiscard]] double clearance_roomy_m(double resolution_m) const { return clearance_hard_m() + resolution_m; }

  /// Of passing cells with less than clearance_hard_m: more than of any with the clearance, less than of escaping.
  [[nodiscard]] double tight_cost_per_m() const { return 0.5 * (1.0 + clearance_weight + escape_cost_per_m); }

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_non_negative("TravelParams", "robot_radius_m", robot_radius_m);
    require_non_negative("TravelParams", "margin_m", margin_m);
    require_positive("TravelParams", "clearance_soft_m", clearance_soft_m);
    require_non_negative("TravelParams", "clearance_weight", clearance_weight);
    require_non_negative("TravelParams", "escape_radius_m", escape_radius_m);
    require(std::isfinite(escape_cost_per_m) && escape_cost_per_m > 1.0 + clearance_weight, "TravelParams",
            "escape_cost_per_m", escape_cost_per_m, "finite and > 1 + clearance_weight");
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "robot_radius_m, margin_m, clearance_soft_m, clearance_weight, escape_radius_m, escape_cost_per_m",
        robot_radius_m, margin_m, clearance_soft_m, clearance_weight, escape_radius_m, escape_cost_per_m);
  }
};

/// The cheapest ways from one place to all others: 8-connected (or 4-, see restart), never cutting a corner, through free cells
/// with the clearance that the robot needs, and at a high cost through those that may hide a passage for it (see
/// TravelParams). When the start itself lacks it (the belief put a wall too near),
/// cells around it that are not occupied and have some clearance may be crossed, at a high cost, until the first is reached that ways
/// lead through; from a start that has none, though free, also those without. One field serves all goals. Safe to read from many threads at once.
class TravelCostField {
 public:
  /// Reaches nothing.
  explicit TravelCostField(const Lattice<2>& lattice)
      : cost_per_m_(lattice, {}, infinite), cost_m_(lattice, {}, infinite), step_to_(lattice, {}, no_step) {}

  /// See restart.
  TravelCostField(const OccupancyGrid<2>& occupancy, const Grid<float, 2>& clearance_m,
                  const Eigen::Vector2d& start_m, const TravelParams& params = {})
      : TravelCostField(occupancy.lattice()) {
    restart(occupancy, clearance_m, start_m, params);
  }

  /// Makes this the field of another start or belief on the same lattice; storage is used again.
  /// `clearance_m` holds the distance from each cell's centre to the centre of the nearest occupied one, as
  /// distance_transform_m returns it, or to anything else that the robot must keep clear of. Nothing can be reached from a start
  /// outside of the grid's box. Throws std::invalid_argument for bad parameters, a start that is not finite, and grids with
  /// different boxes; the field is then as it was. O(cells) to set up and O(reached cells) to search: a bucket queue (Dial 1969),
  /// exact because no step is cheaper than a bucket is wide.
  void restart(const OccupancyGrid<2>& occupancy, const Grid<float, 2>& clearance_m, const Eigen::Vector2d& start_m,
               const TravelParams& params = {}) {
    params.validate();
    require_finite_start(start_m);
    require_equal_boxes("TravelCostField", "clearance_m", clearance_m.box(), "occupancy", occupancy.box());
    const IndexBox<2>& box = occupancy.box();
    start_m_ = start_m;
    proper_max_ = static_cast<float>(1.0 + params.clearance_weight);
    passable_max_ = static_cast<float>(params.tight_cost_per_m());
    no_stay_.clear();
    for (Grid<float, 2>* costs : {&cost_per_m_, &cost_m_}) costs->clear_to(box.padded(1));
    step_to_.clear_to(box.padded(1));
    const Eigen::Vector2d start_cells = occupancy.lattice().to_cells(start_m);
    for (int axis = 0; axis < 2; ++axis) {
      if (!(box.lower[axis] <= start_cells[axis] && start_cells[axis] < box.upper[axis])) return;
    }
    start_ = occupancy.lattice().index_of(start_m);
    rate_cells(occupancy, clearance_m, params);
    if (!is_proper(start_)) open_escape(occupancy, clearance_m, params);
    search(Adjacency::corners, 1.0, params.escape_cost_per_m);
    for (const Offset cell : no_stay_) cost_m_[cell] = infinite;
  }

  /// Makes this the field of a cost per metre of any kind (Isleyen et al., (14) with the edges of footnote 2): infinity where
  /// the robot must not be, > 0 elsewhere. From a start where it must not be, nothing is reached. Throws std::invalid_argument
  /// for a start that is not finite and for a cost that is not > 0 (NaN is not); the field is then as it was. O(cells) to set up and
  /// O(reached cells) to search while the largest cost is some thousand times the smallest at most.
  void restart(const Grid<float, 2>& cost_per_m, const Eigen::Vector2d& start_m, Adjacency adjacency = Adjacency::corners) {
    require_finite_start(start_m);
    float least = infinite;
    float most = 0.0F;
    for (const float cost : cost_per_m.values()) {
      require(cost > 0.0F, "TravelCostField", "cost_per_m", static_cast<double>(cost), "> 0");
      least = std::min(least, cost);
      most = std::max(most, cost < infinite ? cost : 0.0F);
    }
    const IndexBox<2>& box = cost_per_m.box();
    start_m_ = start_m;
    proper_max_ = most;
    passable_max_ = most;
    roomy_max_ = most;
    no_stay_.clear();
    for (Grid<float, 2>* costs : {&cost_per_m_, &cost_m_}) costs->clear_to(box.padded(1));
    step_to_.clear_to(box.padded(1));
    const Eigen::Vector2d start_cells = cost_per_m.lattice().to_cells(start_m);
    for (int axis = 0; axis < 2; ++axis) {
      if (!(box.lower[axis] <= start_cells[axis] && start_cells[axis] < box.upper[axis])) return;
    }
    start_ = cost_per_m.lattice().index_of(start_m);
    const Offset width = cost_per_m.stride(1);
    for (Offset row = 0; row < static_cast<Offset>(cost_per_m.size()); row += width) {
      std::copy_n(cost_per_m.values().begin() + row, width,
                  cost_per_m_.values().begin() + cost_per_m_.offset_of(cost_per_m.index_at(row)));
    }
    if (is_proper(start_)) search(adjacency, static_cast<double>(least), static_cast<double>(most));
  }

  /// What the way to a cell costs, in metres; infinity when there is none or the robot cannot stay there.
  [[nodiscard]] float cost_m(const Index<2>& index) const { return cost_m_.value(index); }

  /// Whether a cell can be got to.
  [[nodiscard]] bool reaches(const Index<2>& index) const { return cost_m(index) < infinite; }

  /// Whether any cell can be got to. O(cells) where none can.
  [[nodiscard]] bool reaches_any() const {
    return std::any_of(cost_m_.values().begin(), cost_m_.values().end(), [](float cost_m) { return cost_m < infinite; });
  }

  /// Whether the robot has the clearance it needs in a cell.
  [[nodiscard]] bool is_proper(const Index<2>& index) const {
    return cost_per_m_.value(index) <= proper_max_;
  }

  /// Whether the robot has room to spare in a cell (clearance_roomy_m). Where a cost of another kind was given, as is_proper.
  [[nodiscard]] bool is_roomy(const Index<2>& index) const { return cost_per_m_.value(index) <= roomy_max_; }

  /// Whether ways may lead through a cell: a proper one, or one that may hide a passage.
  [[nodiscard]] bool is_passable(const Index<2>& index) const {
    return cost_per_m_.value(index) <= passable_max_;
  }

  /// The cost of a metre in a cell, > 0; infinity where the robot cannot travel.
  [[nodiscard]] float cost_per_m(const Index<2>& index) const { return cost_per_m_.value(index); }

  /// The cells of the cheapest way, from the start's to `goal`; empty when there is none.
  [[nodiscard]] std::vector<Index<2>> cells_to(const Index<2>& goal) const {
    std::vector<Index<2>> cells;
    if (!reaches(goal)) return cells;
    cells.push_back(goal);
    Index<2> cell = goal;
    while (!equal(cell, start_)) {
      const auto step = static_cast<std::size_t>(step_to_.value(cell) & step_mask);
      cell[0] -= step_x[step];
      cell[1] -= step_y[step];
      cells.push_back(cell);
    }
    std::reverse(cells.begin(), cells.end());
    return cells;
  }

  [[nodiscard]] const Eigen::Vector2d& start_m() const { return start_m_; }  ///< where all ways begin
  [[nodiscard]] const Lattice<2>& lattice() const { return cost_m_.lattice(); }  ///< of the cells

  /// For archives of states, see docs/mission_file.md, throws what the archive throws: where the robot has clearance and what a metre costs. A field that was loaded
  /// reaches nothing until restart.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(start_m_, roomy_max_, proper_max_, passable_max_, cost_per_m_);
    if constexpr (Archive::is_loading) {
      archive.claim(cost_per_m_.size(), sizeof(float) + 1);
      no_stay_.clear();
      cost_m_.clear_to(cost_per_m_.box());
      step_to_.clear_to(cost_per_m_.box());
    }
  }

 private:
  static constexpr float infinite = std::numeric_limits<float>::infinity();
  static constexpr std::uint8_t no_step = 0;
  static constexpr std::uint8_t step_mask = 7;
  static constexpr std::uint8_t settled = 8;

  /// Counter-clockwise from +x, so odd steps are diagonal.
  static constexpr std::array<int, 8> step_x{1, 1, 0, -1, -1, -1, 0, 1};
  static constexpr std::array<int, 8> step_y{0, 1, 1, 1, 0, -1, -1, -1};

  static void require_finite_start(const Eigen::Vector2d& start_m) {
    if (!std::isfinite(start_m[0]) || !std::isfinite(start_m[1])) {
      throw_invalid("TravelCostField", "start_m", tuple_text(start_m), "finite");
    }
  }

  void rate_cells(const OccupancyGrid<2>& occupancy, const Grid<float, 2>& clearance_m,
                  const TravelParams& params) {
    const auto hard_m = static_cast<float>(params.clearance_hard_m());
    const auto tight_m = static_cast<float>(params.clearance_tight_m(occupancy.resolution_m()));
    const auto roomy_m = static_cast<float>(params.clearance_roomy_m(occupancy.resolution_m()));
    const auto weight = static_cast<float>(params.clearance_weight);
    const auto per_soft_m = static_cast<float>(1.0 / params.clearance_soft_m);
    const auto cost_with = [weight, per_soft_m](float of_m) {
      const float lack = std::max(0.0F, 1.0F - of_m * per_soft_m);
      return 1.0F + weight * lack * lack;
    };
    roomy_max_ = cost_with(roomy_m);
    const Offset width = occupancy.stride(1);
    for (Offset row = 0; row < static_cast<Offset>(occupancy.size()); row += width) {
      const Offset first = cost_per_m_.offset_of(occupancy.index_at(row));
      float* const rated = &cost_per_m_[first];
      for (Offset i = 0; i < width; ++i) {
        const bool proper = occupancy[row + i] == Occupancy::free && clearance_m[row + i] >= hard_m;
        rated[i] = proper ? cost_with(clearance_m[row + i]) : infinite;
        if (proper || occupancy[row + i] != Occupancy::free || clearance_m[row + i] < tight_m) continue;
        rated[i] = passable_max_;
        no_stay_.push_back(first + i);
      }
    }
  }

  void open_escape(const OccupancyGrid<2>& occupancy, const Grid<float, 2>& clearance_m, const TravelParams& params) {
    const auto escape = static_cast<float>(params.escape_cost_per_m);
    const int reach = static_cast<int>(
        std::min(params.escape_radius_m / occupancy.resolution_m(), static_cast<double>(occupancy.size())));
    const IndexBox<2>& box = occupancy.box();
    // Where there is no clearance at all, a place that is closed to the robot, it may go only to get out of such a place.
    const bool is_closed =
        clearance_m[clearance_m.offset_of(start_)] == 0.0F && occupancy.value(start_) != Occupancy::occupied;
    for (int y = std::max(start_[1] - reach, box.lower[1]); y < std::min(start_[1] + reach + 1, box.upper[1]); ++y) {
      for (int x = std::max(start_[0] - reach, box.lower[0]); x < std::min(start_[0] + reach + 1, box.upper[0]); ++x) {
        const Index<2> index(x, y);
        const Eigen::Vector2d offset(x - start_[0], y - start_[1]);
        if (norm(offset) * occupancy.resolution_m() > params.escape_radius_m) continue;
        const bool opens = !is_passable(index) && occupancy.value(index) != Occupancy::occupied &&
                           (is_closed || clearance_m[clearance_m.offset_of(index)] > 0.0F);
        if (!opens && !equal(index, start_)) continue;
        no_stay_.push_back(cost_per_m_.offset_of(index));
        cost_per_m_.set(index, escape);
      }
    }
  }

  /// A bucket queue. Where the costs differ so much that buckets as narrow as the cheapest step would be too many, a cell may be
  /// found cheaper again after its neighbours were reached from it, and is then taken again.
  void search(Adjacency adjacency, double cost_min_per_m, double cost_max_per_m) {
    const float half_m = static_cast<float>(0.5 * cost_m_.resolution_m());
    const float half_diagonal_m = static_cast<float>(0.5 * std::numbers::sqrt2 * cost_m_.resolution_m());
    constexpr double buckets_max = 4096.0;
    const double step_max_m = std::numbers::sqrt2 * cost_m_.resolution_m() * cost_max_per_m;
    // A little under the cheapest step, so that rounding never puts a step's end into the bucket of its
    // beginning.
    const float width_m = static_cast<float>(std::max(0.99 * cost_m_.resolution_m() * cost_min_per_m, step_max_m / buckets_max));
    std::vector<std::vector<Offset>> buckets(
        static_cast<std::size_t>(step_max_m / static_cast<double>(width_m)) + 3);

    std::array<Offset, 8> offset_steps{};
    for (std::size_t s = 0; s < 8; ++s) offset_steps[s] = step_x[s] + step_y[s] * cost_m_.stride(1);

    std::size_t waiting = 1;
    cost_m_.set(start_, 0.0F);
    buckets[0].push_back(cost_m_.offset_of(start_));
    for (std::size_t b = 0; waiting > 0; b = (b + 1) % buckets.size()) {
      std::vector<Offset>& bucket = buckets[b];
      for (std::size_t next = 0; next < bucket.size(); ++next) {
        const Offset from = bucket[next];
        --waiting;
        if ((step_to_[from] & settled) != 0) continue;
        step_to_[from] |= settled;
        const float from_cost_m = cost_m_[from];
        const float from_per_m = cost_per_m_[from];
        // Out of a place to escape from into any open cell, out of all others into passable ones only.
        const float enter_max = std::max(from_per_m, passable_max_);
        const auto relax = [&](std::size_t step, Offset to, float half_step_m) {
          const float to_cost_m = from_cost_m + half_step_m * (from_per_m + cost_per_m_[to]);
          if (to_cost_m < cost_m_[to]) {
            cost_m_[to] = to_cost_m;
            step_to_[to] = static_cast<std::uint8_t>(step);
            buckets[static_cast<std::size_t>(to_cost_m / width_m) % buckets.size()].push_back(to);
            ++waiting;
          }
        };
        std::array<bool, 4> open{};
        for (std::size_t face = 0; face < 4; ++face) {
          const Offset to = from + offset_steps[2 * face];
          open[face] = cost_per_m_[to] <= enter_max;
          if (open[face]) relax(2 * face, to, half_m);
        }
        if (adjacency == Adjacency::faces) continue;
        for (std::size_t face = 0; face < 4; ++face) {
          const Offset to = from + offset_steps[2 * face + 1];
          if (open[face] && open[(face + 1) % 4] && cost_per_m_[to] <= enter_max) {
            relax(2 * face + 1, to, half_diagonal_m);
          }
        }
      }
      bucket.clear();
    }
  }

  Eigen::Vector2d start_m_{0.0, 0.0};
  Index<2> start_{0, 0};
  float roomy_max_ = 1.0F;     ///< no roomy cell costs more a metre, every other one does
  float proper_max_ = 1.0F;    ///< no proper cell costs more a metre, every other one does
  float passable_max_ = 1.0F;  ///< no passable cell costs more a metre, every place to escape from does
  // One ring of cells larger than the belief: it is never entered, so no step needs to look whether it leaves the grid.
  Grid<float, 2> cost_per_m_;
  Grid<float, 2> cost_m_;
  std::vector<Offset> no_stay_;    ///< what may be crossed, but is no goal
  Grid<std::uint8_t, 2> step_to_;  ///< the last step of the way to a cell, and whether it is final
};

}  // namespace incognita
