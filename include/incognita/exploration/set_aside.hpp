/// Places that an explorer has given up for as long as the map around them stays as it is.
#pragma once

#include <cstdlib>
#include <vector>

#include <Eigen/Core>

#include "incognita/map/occupancy.hpp"

namespace incognita {

/// How many cells of the square that reaches `radius_m` from a point to each side are known (none outside of the box).
[[nodiscard]] inline int count_known(const OccupancyGrid<2>& occupancy, const Eigen::Vector2d& center_m,
                                     double radius_m) {
  const Box<Eigen::Vector2d> around{center_m, center_m};
  const IndexBox<2> box = occupancy.lattice().cells_of(around.padded(radius_m));
  int known = 0;
  for (int y = box.lower.y(); y < box.upper.y(); ++y) {
    for (int x = box.lower.x(); x < box.upper.x(); ++x) {
      if (occupancy.value({x, y}) != Occupancy::unknown) ++known;
    }
  }
  return known;
}

/// When two places are the same and when the map around one has changed.
struct SetAsideParams {
  double radius_m = 0.5;        ///< a place within this distance of one set aside is the same place
  double watch_radius_m = 1.0;  ///< half the side of the square around it that may change
  int change_cells_min = 15;    ///< a change of the number of known cells there that counts as one

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("SetAsideParams", "radius_m", radius_m);
    require_positive("SetAsideParams", "watch_radius_m", watch_radius_m);
    require(change_cells_min >= 1, "SetAsideParams", "change_cells_min", change_cells_min, ">= 1");
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("radius_m, watch_radius_m, change_cells_min", radius_m, watch_radius_m, change_cells_min);
  }
};

/// A goal that could not be reached, or that told nothing new when it was, is not tried again until the map around it
/// has changed.
class SetAsidePlaces {
 public:
  /// With nothing set aside; the parameters must be valid.
  explicit SetAsidePlaces(const SetAsideParams& params = {}) : params_(params) {}

  [[nodiscard]] bool empty() const { return places_.empty(); }  ///< whether nothing is set aside

  /// Sets a place aside, in the grid's frame. O(cells within watch_radius_m).
  void add(const Eigen::Vector2d& place_m, const OccupancyGrid<2>& occupancy) {
    places_.push_back({place_m, count_known(occupancy, place_m, params_.watch_radius_m)});
  }

  /// Whether one that was set aside is near, and nothing has changed there. O(places near * cells within watch_radius_m).
  [[nodiscard]] bool contains(const Eigen::Vector2d& place_m, const OccupancyGrid<2>& occupancy) const {
    for (const Place& place : places_) {
      if (distance(place.position_m, place_m) > params_.radius_m) continue;
      const int known = count_known(occupancy, place.position_m, params_.watch_radius_m);
      if (std::abs(known - place.known_cells) < params_.change_cells_min) return true;
    }
    return false;
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("set_aside", params_);
    archive(places_);
  }

 private:
  struct Place {
    Eigen::Vector2d position_m;
    int known_cells;

    template <class Archive>
    void archive_state(Archive& archive) {
      archive(position_m, known_cells);
    }
  };

  SetAsideParams params_;
  std::vector<Place> places_;
};

}  // namespace incognita
