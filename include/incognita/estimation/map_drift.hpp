/// How far a map that is built while localising in it may have drifted, piece by piece.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/angles.hpp"
#include "incognita/core/error.hpp"
#include "incognita/estimation/pose_belief.hpp"
#include "incognita/estimation/yaw_update.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// How far a twist (v_x, v_y, omega) about the map's origin, small, moves a point.
[[nodiscard]] inline Eigen::Vector2d twist_shift_m(const Eigen::Vector3d& twist, const Eigen::Vector2d& at_m) {
  return {twist[0] - twist[2] * at_m[1], twist[1] + twist[2] * at_m[0]};
}

/// The pose that a small twist about the map's origin moves `pose` to.
[[nodiscard]] inline Pose2 moved_pose(const Pose2& pose, const Eigen::Vector3d& twist) {
  const Eigen::Vector2d position_m = sum(pose.position(), twist_shift_m(twist, pose.position()));
  return {position_m[0], position_m[1], wrap_angle_rad(pose.yaw_rad + twist[2])};
}

/// The twist about the map's origin that moves one pose to another near it: the inverse of moved_pose.
[[nodiscard]] inline Eigen::Vector3d twist_between(const Pose2& from, const Pose2& to) {
  const double turn_rad = angle_between_rad(from.yaw_rad, to.yaw_rad);
  return {to.x_m - from.x_m + turn_rad * from.y_m, to.y_m - from.y_m - turn_rad * from.x_m, turn_rad};
}

/// Surfaces that are measured from a wrong pose are wrong by that pose's error, and whoever registers to them later cannot
/// do better. The error is a twist (v_x, v_y, omega) about the map's origin: the robot's motion does not change it, a
/// pose registered to a piece of the map takes it over, and so do surfaces learned from there. So a pose's covariance has
/// two parts: that of the pose in the piece it is registered to, which scans reduce, and the drift of that piece, which
/// only older pieces reduce. Each piece stands for the surfaces first seen within a few scans; its drift is that of the
/// reference at its birth plus a share of the pose's covariance in it. Pieces with less drift than others are older
/// links of the chain, so two pieces differ by the difference of their covariances. What is measured of a piece's turn moves
/// it and, by their common part, all others. A piece's surfaces are shifted as they are looked at, until somebody moves
/// them where they are stored and says so by settle(). Not thread safe.
class MapDrift {
 public:
  /// How a map is cut into pieces, and what a new one takes over.
  struct Params {
    /// How much of the pose's covariance a new piece takes over. Not all: its surfaces are means over many scans, whose
    /// errors are independent after a few of them. 0 switches the model off: the map is taken for the truth.
    double inherited_share = 0.15;
    /// The reference is the piece below which this share of the matched beams falls, by drift: the oldest in sight, but not
    /// one that a few wrong matches suggest. In [0, 1].
    double reference_quantile = 0.1;
    int scans_per_piece = 10;  ///< >= 1; memory is 128 bytes a piece

    /// Throws std::invalid_argument for values outside of their bounds.
    void validate() const {
      require_non_negative("MapDrift", "inherited_share", inherited_share);
      require(reference_quantile >= 0.0 && reference_quantile <= 1.0, "MapDrift", "reference_quantile",
              reference_quantile, "in [0, 1]");
      require(scans_per_piece >= 1, "MapDrift", "scans_per_piece", scans_per_piece, ">= 1");
    }

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Fields>
    void list_fields(Fields& fields) const {
      fields("inherited_share, reference_quantile, scans_per_piece", inherited_share, reference_quantile, scans_per_piece);
    }
  };

  MapDrift() = default;  ///< with the default parameters

  /// Throws std::invalid_argument for parameters outside of their bounds.
  explicit MapDrift(const Params& params) : params_(params) { params_.validate(); }

  /// The drift of the reference: a covariance of twists.
  [[nodiscard]] const Eigen::Matrix3d& covariance() const { return reference_.drift; }

  /// What poses are registered to.
  struct Reference {
    Eigen::Matrix3d drift = zero<Eigen::Matrix3d>();  ///< a covariance of twists
    double turn_at_birth_rad2 = 0.0;                  ///< the variance of its piece's turn when that was born
    int piece = 0;                                    ///< its number

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Archive>
    void archive_state(Archive& archive) {
      archive(drift, turn_at_birth_rad2, piece);
    }
  };

  [[nodiscard]] const Reference& reference() const { return reference_; }  ///< as last chosen

  /// Takes an earlier reference() back.
  void restore(const Reference& reference) { reference_ = reference; }

  /// What the reference's drift makes of a pose registered to it, at `position_m`: to be added to its own covariance.
  [[nodiscard]] Eigen::Matrix3d covariance_at(const Eigen::Vector2d& position_m) const {
    return carried_covariance(reference_.drift, position_m);
  }

  /// The piece that surfaces learned by this scan belong to. `covariance` is the pose's in the reference.
  [[nodiscard]] int piece_of_scan(const Eigen::Matrix3d& covariance, const Eigen::Vector2d& position_m) {
    if (begins_piece_ || scans_in_piece_ == params_.scans_per_piece) {
      begins_piece_ = false;
      scans_in_piece_ = 0;
      Eigen::Matrix3d born = reference_.drift;
      add_to(born, carried_covariance(covariance, {-position_m[0], -position_m[1]}), params_.inherited_share);
      pieces_.push_back({born, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, born(2, 2)});
    }
    ++scans_in_piece_;
    return static_cast<int>(pieces_.size()) - 1;
  }

  /// The next scan begins a new piece.
  void begin_piece() { begins_piece_ = true; }

  [[nodiscard]] int scans_per_piece() const { return params_.scans_per_piece; }  ///< the most that a piece is born of

  /// The number of pieces.
  [[nodiscard]] std::size_t size() const { return pieces_.size(); }

  /// Begins the choice of a reference for a pose at position_m.
  void begin_matches(const Eigen::Vector2d& position_m) {
    position_m_ = position_m;
    matched_.clear();
  }

  /// A beam is matched with a surface of this piece, which is not checked.
  void add_match(int piece) {
    matched_.push_back({position_variance_m2(pieces_[static_cast<std::size_t>(piece)].drift), piece});
  }

  /// Makes the chosen piece the reference, and returns what its choice adds to the pose's covariance: the old reference's
  /// drift beyond the new one's. Nothing changes without matches.
  [[nodiscard]] Eigen::Matrix3d choose_reference() {
    Eigen::Matrix3d added = zero<Eigen::Matrix3d>();
    if (matched_.empty()) return added;
    const auto [chosen_m2, piece] = matched_[of_rank(params_.reference_quantile)];
    const double old_m2 = position_variance_m2(reference_.drift);
    // In proportion, which is positive semi-definite whatever the two covariances' shapes.
    if (old_m2 > chosen_m2) add_to(added, covariance_at(position_m_), 1.0 - chosen_m2 / old_m2);
    const Piece& chosen = pieces_[static_cast<std::size_t>(piece)];
    reference_ = {chosen.drift, chosen.turn_at_birth_rad2, piece};
    return added;
  }

  /// How far a piece is shifted against where its surfaces are stored, at a point of the map that is not far from it.
  [[nodiscard]] Eigen::Vector2d shift_m(int piece, const Eigen::Vector2d& at_m) const {
    const Piece& of = pieces_[static_cast<std::size_t>(piece)];
    return twist_shift_m(difference(of.twist, of.settled), at_m);
  }

  /// How far a piece was moved since it was born: a twist about the map's origin.
  [[nodiscard]] const Eigen::Vector3d& twist(int piece) const { return pieces_[static_cast<std::size_t>(piece)].twist; }

  /// Moves a piece to where it is now known to be. The covariance of its drift stays as it was, so it is cautious.
  void set_twist(int piece, const Eigen::Vector3d& twist) { pieces_[static_cast<std::size_t>(piece)].twist = twist; }

  /// All surfaces have been moved by shift_m of their piece and are stored where they are: shifts begin anew at 0.
  void settle() {
    for (Piece& piece : pieces_) piece.settled = piece.twist;
  }

  /// The turn of the reference was measured: it is `turn_rad` more than believed, with this variance. Turns the pieces that
  /// share in it and returns the twist of the reference, which a pose in it must take part in. O(pieces).
  Eigen::Vector3d correct_turn(double turn_rad, double variance_rad2) {
    const double prior_rad2 = reference_.drift(2, 2);
    Eigen::Vector3d twist(0.0, 0.0, 0.0);
    if (prior_rad2 <= 0.0) return twist;
    twist = scaled(column(reference_.drift, 2), turn_rad / (prior_rad2 + variance_rad2));
    const Eigen::Matrix3d posterior = yaw_updated_covariance(reference_.drift, variance_rad2);
    const double learned_rad2 = prior_rad2 - posterior(2, 2);
    for (Piece& piece : pieces_) {
      const double own_rad2 = piece.drift(2, 2);
      if (own_rad2 <= 0.0) continue;
      // Of two links of a chain of independent steps, the older one's error is common to both: the older turns by its
      // share of the reference's turn, the newer by all of it. Measuring the reference does not change the share.
      const double share = std::min(1.0, piece.turn_at_birth_rad2 / reference_.turn_at_birth_rad2);
      const Eigen::Vector3d moved = share < 1.0 ? scaled(column(piece.drift, 2), share * twist[2] / own_rad2) : twist;
      for (int axis = 0; axis < 3; ++axis) piece.twist[axis] += moved[axis];
      // As if its own turn had been measured with the noise that takes as much from its variance.
      const double own_learned_rad2 = share * share * learned_rad2;
      if (own_learned_rad2 <= 0.0 || own_learned_rad2 >= own_rad2) continue;
      piece.drift = yaw_updated_covariance(piece.drift, own_rad2 * (own_rad2 / own_learned_rad2 - 1.0));
    }
    reference_.drift = posterior;
    return twist;
  }

  /// The variance of a residual that drifts with `piece`, beyond the reference's; `jacobian` is the residual's derivative by
  /// the twist.
  [[nodiscard]] double variance_beyond_reference_m2(int piece, const Eigen::Vector3d& jacobian) const {
    const Eigen::Matrix3d& drift = pieces_[static_cast<std::size_t>(piece)].drift;
    double variance_m2 = 0.0;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        variance_m2 += jacobian[row] * (drift(row, column) - reference_.drift(row, column)) * jacobian[column];
      }
    }
    return std::max(0.0, variance_m2);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("drift", params_);
    archive(reference_, pieces_, scans_in_piece_, begins_piece_);
    archive.require(reference_.piece >= 0 && (reference_.piece == 0 || static_cast<std::size_t>(reference_.piece) < size()),
                    "the piece that poses are registered to is not there");
    archive.require(!pieces_.empty() || begins_piece_, "a map has no pieces");
  }

 private:
  struct Piece {
    Eigen::Matrix3d drift;
    Eigen::Vector3d twist;    // how far it was moved since it was born ...
    Eigen::Vector3d settled;  // ... and how much of that its stored surfaces have taken part in
    double turn_at_birth_rad2;

    template <class Archive>
    void archive_state(Archive& archive) {
      archive(drift, twist, settled, turn_at_birth_rad2);
    }
  };

  struct Match {
    double drift_m2;  // at the position
    int piece;
  };

  [[nodiscard]] static Eigen::Vector3d column(const Eigen::Matrix3d& matrix, int index) {
    return {matrix(0, index), matrix(1, index), matrix(2, index)};
  }

  /// The place of the match below which a share `quantile` of them lies, by drift. By counting: there are some tens, and
  /// every program that includes this header would pay for an instance of nth_element.
  [[nodiscard]] std::size_t of_rank(double quantile) const {
    const auto rank = static_cast<std::size_t>(quantile * static_cast<double>(matched_.size() - 1));
    for (std::size_t i = 0; i < matched_.size(); ++i) {
      std::size_t below = 0;
      for (std::size_t j = 0; j < matched_.size(); ++j) {
        if (matched_[j].drift_m2 < matched_[i].drift_m2 || (matched_[j].drift_m2 == matched_[i].drift_m2 && j < i)) ++below;
      }
      if (below == rank) return i;
    }
    return 0;
  }

  /// The sum of the variances of the two coordinates, at the position that is being matched.
  [[nodiscard]] double position_variance_m2(const Eigen::Matrix3d& drift) const {
    const double x = position_m_[0];
    const double y = position_m_[1];
    return drift(0, 0) + drift(1, 1) + 2.0 * (x * drift(1, 2) - y * drift(0, 2)) + (x * x + y * y) * drift(2, 2);
  }

  Params params_;
  Reference reference_;
  std::vector<Piece> pieces_;
  std::vector<Match> matched_;
  Eigen::Vector2d position_m_{0.0, 0.0};
  int scans_in_piece_ = 0;
  bool begins_piece_ = true;
};

}  // namespace incognita
