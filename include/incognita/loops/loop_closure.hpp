/// Loops: what a robot finds out about its map when it returns to surfaces that it first saw long ago.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "incognita/core/error.hpp"
#include "incognita/estimation/compass.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/estimation/information.hpp"
#include "incognita/estimation/map_drift.hpp"
#include "incognita/estimation/registration.hpp"
#include "incognita/estimation/relocation.hpp"
#include "incognita/estimation/surface_map.hpp"
#include "incognita/loops/drift_graph.hpp"
#include "incognita/loops/kept_scans.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// Spreads what returns reveal back over the map. Each piece of MapDrift is a body of a DriftGraph. When one is born, the
/// scan that it is born with measures it against every piece whose surfaces that scan meets: point-to-line residuals, kept
/// as their information. Where it meets surfaces of two ages, those first seen long ago and those of the way
/// there, it is registered to each alone, so that a discrepancy is measured and not rejected as outliers. Then the graph is
/// solved and the pieces are moved to where they cost least. Surfaces follow at once; a belief is drawn again from the scans
/// kept, by whoever owns it (see is_redraw_due), when something has moved noticeably. What a pose's covariance says of the
/// map's drift is not reduced. A discrepancy beyond 0.1 m is not seen here, see Relocation: a
/// wider reach closed loops between equal rooms.
/// The Loops of a BasicDvlEkf. Memory: some 3 kB a piece, of which there is one in ten scans, and the scans kept. Time: in
/// buildings 0.05 to 0.8 ms a scan in the mean, more where walls are rough, most of it in solutions of 10 to 50 ms at most every tenth
/// piece and in drawing the belief again; both grow with the time driven. Not thread safe.
class LoopClosure {
 public:
  /// What counts as a return, and when the map is moved and drawn again.
  struct Params {
    bool closes_loops = true;           ///< false: nothing is measured, kept or moved
    double age_share_min = 0.1;         ///< of a scan's beams must meet old surfaces, and at least so many new ones, in (0, 0.5]
    int age_gap_pieces = 30;            ///< between old and new, >= 1
    int pieces_between_solutions = 10;  ///< >= 1
    /// Solved anew when the fits of a scan to old surfaces and to new ones differ by more than this, for the robot or for what it
    /// sees 5 m away: while they agree, a solution only moves pieces by the noise of the fits. >= 0
    double solution_shift_m = 0.01;
    double redraw_shift_m = 0.05;       ///< a belief is drawn again when it is off by this much: half a cell of 0.1 m
    int scans_max = 20000;              ///< kept at most, see KeptScans: 30 MB with 360 beams

    /// Throws std::invalid_argument for values outside of their bounds.
    void validate() const {
      require(age_share_min > 0.0 && age_share_min <= 0.5, "LoopClosure", "age_share_min", age_share_min, "in (0, 0.5]");
      require(age_gap_pieces >= 1, "LoopClosure", "age_gap_pieces", age_gap_pieces, ">= 1");
      require(pieces_between_solutions >= 1, "LoopClosure", "pieces_between_solutions", pieces_between_solutions, ">= 1");
      require_non_negative("LoopClosure", "solution_shift_m", solution_shift_m);
      require_positive("LoopClosure", "redraw_shift_m", redraw_shift_m);
      require(scans_max >= 2, "LoopClosure", "scans_max", scans_max, ">= 2");
    }

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Fields>
    void list_fields(Fields& fields) const {
      fields(
          "closes_loops, age_share_min, age_gap_pieces, pieces_between_solutions, solution_shift_m, redraw_shift_m, scans_max",
          closes_loops, age_share_min, age_gap_pieces, pieces_between_solutions, solution_shift_m, redraw_shift_m, scans_max);
    }
  };

  /// What a filter knows when a piece is born.
  struct Keyframe {
    const Scan<2>& scan;                      ///< must outlive the call
    Pose2 pose;                               ///< where the scan was taken
    std::optional<Compass::Heading> heading;  ///< that the walls in the scan give
  };

  /// With the default parameters.
  LoopClosure() : LoopClosure(Params{}) {}

  /// Throws std::invalid_argument for parameters outside of their bounds.
  explicit LoopClosure(const Params& params) : params_(params), kept_(params.scans_max) { params.validate(); }

  /// Keeps a scan that was learned in `piece`.
  void keep(const Scan<2>& scan, const PoseBelief& belief, int piece, const MapDrift& drift) {
    if (params_.closes_loops) kept_.add(scan, belief, piece, drift.twist(piece));
  }

  /// The robot has moved at `position_m`, with noise of this covariance.
  void add_motion(const Eigen::Matrix3d& covariance, const Eigen::Vector2d& position_m) {
    step_covariance_ += carried_covariance(covariance, -position_m);
  }

  /// The robot was found elsewhere. If the map may have drifted so far, it has, and what came before should be where the
  /// robot now is; else its wheels slipped or it was carried off, which says nothing of the map. Returns whether a piece
  /// should begin.
  [[nodiscard]] bool add_jump(const PoseBelief& from, const PoseBelief& to) {
    if (!params_.closes_loops) return false;
    const Eigen::Vector3d off(to.pose.x_m - from.pose.x_m, to.pose.y_m - from.pose.y_m,
                              angle_between_rad(from.pose.yaw_rad, to.pose.yaw_rad));
    const Eigen::Matrix3d covariance = from.covariance + to.covariance;
    if (off.dot(covariance.inverse() * off) >= jump_mahalanobis2_max) {
      constexpr double carried_m2 = Relocation::carried_m * Relocation::carried_m;
      add_motion(diagonal_covariance(carried_m2, carried_m2, std::numbers::pi), from.pose.position());
      return true;
    }
    add_motion(to.covariance, to.pose.position());
    step_jump_ += twist_between(from.pose, to.pose);
    is_solution_due_ = true;
    return true;
  }

  /// Whether a robot that was registered to piece `from`, among the youngest, and now is to piece `to` has returned: a piece
  /// should begin there, before what is new is bent to fit what is old.
  [[nodiscard]] bool is_return(int from, int to) const {
    const bool was_in_the_new = from >= graph_.bodies() - params_.age_gap_pieces;
    return params_.closes_loops && was_in_the_new && from - to >= params_.age_gap_pieces;
  }

  /// Measures the youngest piece of `drift` by the scan that it is born with, whose surfaces must not have been added yet, and,
  /// when the robot has returned, moves pieces and surfaces. Returns the twist by which the robot's pose moves with its
  /// piece.
  [[nodiscard]] Eigen::Vector3d add_keyframe(const Keyframe& keyframe, const RegistrationParams& registration,
                                             SurfaceMap<2>& surfaces, MapDrift& drift) {
    const Eigen::Vector3d unmoved = Eigen::Vector3d::Zero();
    if (!params_.closes_loops) return unmoved;
    const int piece = static_cast<int>(drift.size()) - 1;
    while (graph_.bodies() <= piece) {  // once, but for pieces whose scan could not be learned
      const int body = graph_.add_body();
      if (body > 0) link_to_last(body, drift);
    }
    if (piece == 0) return unmoved;
    if (keyframe.heading) link_to_heading(piece, keyframe.pose.yaw_rad, *keyframe.heading, drift);
    const std::vector<int> met = pieces_met(keyframe, registration, surfaces, {drift, 0, piece});
    if (met.empty()) return unmoved;
    if (const int first_new = first_after_gap(met, keyframe.scan.size()); first_new == 0) {
      link_to_surfaces(piece, keyframe, keyframe.pose, registration, surfaces, {drift, 0, piece});
    } else {
      const std::optional<Pose2> by_old = link_to_age(piece, keyframe, registration, surfaces, {drift, 0, first_new});
      const std::optional<Pose2> by_new = link_to_age(piece, keyframe, registration, surfaces, {drift, first_new, piece});
      if (by_old && shift_m(*by_old, by_new.value_or(keyframe.pose)) > params_.solution_shift_m) is_solution_due_ = true;
    }
    if (!is_solution_due_ || piece < solved_at_ + params_.pieces_between_solutions) return unmoved;
    return solve(piece, surfaces, drift);
  }

  /// Whether the kept scans are now known to have been taken so far from where the belief has them that it should be drawn
  /// again; until redrawn().
  [[nodiscard]] bool is_redraw_due() const { return is_redraw_due_; }
  /// To be called when the belief has been drawn again.
  void redrawn() {
    is_redraw_due_ = false;
    ++redraws_;
  }

  /// How often the belief was drawn again.
  [[nodiscard]] int redraws() const { return redraws_; }

  [[nodiscard]] const KeptScans& kept() const { return kept_; }  ///< the scans to draw the belief from
  [[nodiscard]] const DriftGraph& graph() const { return graph_; }  ///< the pieces of the map and what ties them

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws. `pieces` is how many pieces the map has.
  template <class Archive>
  void archive_state(Archive& archive, std::size_t pieces) {
    archive.check("loops", params_);
    archive(graph_);
    kept_.archive_state(archive, pieces);
    archive(step_covariance_, step_jump_, solved_at_, is_solution_due_, is_redraw_due_, redraws_);
    archive.require(static_cast<std::size_t>(graph_.bodies()) <= pieces, "there are more bodies than pieces of the map");
    archive.require(solved_at_ >= 0 && solved_at_ <= graph_.bodies(), "loops were solved by a piece that is not there");
  }

 private:
  /// Surfaces of the pieces in [first, end), where they are now known to be.
  struct SurfacesOfAge : CertainSurfaces {
    SurfacesOfAge(const MapDrift& map_drift, int first_piece, int end_piece)
        : drift(map_drift), first(first_piece), end(end_piece) {}

    const MapDrift& drift;
    int first;
    int end;

    [[nodiscard]] bool admits(const Surface<2>& surface) const { return surface.piece >= first && surface.piece < end; }
    [[nodiscard]] Eigen::Vector2d shift_m(const Surface<2>& surface, const Eigen::Vector2d& at_m) const {
      return drift.shift_m(surface.piece, at_m);
    }
  };

  /// Moves everything to where it costs least, and returns how far `piece` has moved.
  [[nodiscard]] Eigen::Vector3d solve(int piece, SurfaceMap<2>& surfaces, MapDrift& drift) {
    is_solution_due_ = false;
    solved_at_ = piece;
    const Eigen::Vector3d before = drift.twist(piece);
    const std::vector<Eigen::Vector3d> twists = graph_.solve();
    for (std::size_t body = 0; body < twists.size(); ++body) drift.set_twist(static_cast<int>(body), twists[body]);
    if (kept_.unsettled_max_m(drift) > params_.redraw_shift_m) {
      surfaces.rearrange([&drift](int of, const Eigen::Vector2d& at_m) { return drift.shift_m(of, at_m); });
      drift.settle();
      is_redraw_due_ = true;
    }
    return drift.twist(piece) - before;
  }

  /// The way since the last piece was born, as the filter has it.
  void link_to_last(int piece, const MapDrift& drift) {
    // No step is known better than to a millimetre and a milliradian, nor has a zero covariance an inverse.
    const Eigen::Matrix3d information = (step_covariance_ + 1e-6 * Eigen::Matrix3d::Identity()).inverse();
    graph_.add_link(piece - 1, piece, information, information * (drift_between(piece - 1, piece, drift) - step_jump_));
    step_covariance_ = Eigen::Matrix3d::Zero();
    step_jump_ = Eigen::Vector3d::Zero();
  }

  /// The compass heard with one scan stands for those with which the piece grows.
  void link_to_heading(int piece, double yaw_rad, const Compass::Heading& heading, const MapDrift& drift) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    information(2, 2) = drift.scans_per_piece() / heading.variance_rad2;
    const double turn_rad = drift.twist(piece)[2] + angle_between_rad(yaw_rad, heading.yaw_rad);
    graph_.add_link(0, piece, information, {0.0, 0.0, information(2, 2) * turn_rad});
  }

  /// Calls visit(surface, match, end_point_m) for each hit that meets a surface, from `pose`.
  template <class Visit>
  static void for_each_match(const Scan<2>& scan, const Pose2& pose, const RegistrationParams& registration,
                             const SurfaceMap<2>& surfaces, const SurfacesOfAge& of_age, Visit&& visit) {
    const Eigen::Matrix2d rotation = pose.rotation();
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.reading(beam) != Reading::hit) continue;
      const Eigen::Vector2d direction = rotation * scan.direction(beam);
      const Eigen::Vector2d end_point_m = pose.position() + direction * scan.range_m(beam);
      const SurfaceMatch match = match_surface(surfaces, end_point_m, direction, registration, of_age);
      if (match.surface != nullptr) visit(match, end_point_m);
    }
  }

  /// The pieces whose surfaces the scan meets, one a beam, oldest first.
  [[nodiscard]] static std::vector<int> pieces_met(const Keyframe& keyframe, const RegistrationParams& registration,
                                                   const SurfaceMap<2>& surfaces, const SurfacesOfAge& older) {
    std::vector<int> pieces;
    for_each_match(keyframe.scan, keyframe.pose, registration, surfaces, older,
                   [&](const SurfaceMatch& match, const Eigen::Vector2d&) { pieces.push_back(match.surface->piece); });
    std::sort(pieces.begin(), pieces.end());
    return pieces;
  }

  /// The first piece after the widest gap in age that leaves enough beams on either side; 0 when none is wide enough.
  [[nodiscard]] int first_after_gap(const std::vector<int>& pieces, std::size_t beams) const {
    const std::size_t enough = beams_of_an_age(beams);
    int widest = params_.age_gap_pieces - 1;
    int first = 0;
    for (std::size_t i = enough; i + enough <= pieces.size(); ++i) {
      const int gap = pieces[i] - pieces[i - 1];
      if (gap <= widest) continue;
      widest = gap;
      first = pieces[i];
    }
    return first;
  }

  [[nodiscard]] std::size_t beams_of_an_age(std::size_t beams) const {
    return std::max<std::size_t>(1, static_cast<std::size_t>(params_.age_share_min * static_cast<double>(beams)));
  }

  /// Registers the scan to the surfaces of one age and measures `piece` against theirs from there. Returns where that is; nothing
  /// where there were not enough of them.
  std::optional<Pose2> link_to_age(int piece, const Keyframe& keyframe, const RegistrationParams& registration,
                   const SurfaceMap<2>& surfaces, const SurfacesOfAge& of_age) {
    RegistrationParams alone = registration;
    alone.iterations = std::max(registration.iterations, age_iterations);
    const PoseBelief prior{keyframe.pose, diagonal_covariance(0.05 * 0.05, 0.05 * 0.05, 0.02 * 0.02)};
    const Registration found = register_scan(prior, keyframe.scan, surfaces, alone, of_age);
    if (found.associations < beams_of_an_age(keyframe.scan.size())) return std::nullopt;
    link_to_surfaces(piece, keyframe, found.belief.pose, registration, surfaces, of_age);
    return found.belief.pose;
  }

  /// Measures `piece` against the pieces whose surfaces its scan meets from `pose`, which is where it would have been taken
  /// if they were right.
  void link_to_surfaces(int piece, const Keyframe& keyframe, const Pose2& pose, const RegistrationParams& registration,
                        const SurfaceMap<2>& surfaces, const SurfacesOfAge& of_age) {
    struct Met {
      int piece;
      Information information;
    };
    std::vector<Met> met;
    double matches = 0.0;
    for_each_match(keyframe.scan, pose, registration, surfaces, of_age,
                   [&](const SurfaceMatch& match, const Eigen::Vector2d& end_point_m) {
      matches += 1.0;
      const int of = match.surface->piece;
      auto found = std::find_if(met.begin(), met.end(), [of](const Met& m) { return m.piece == of; });
      if (found == met.end()) found = met.insert(met.end(), Met{of, {}});
      const double weight = robust_weight(match.residual_m(), registration) / registration.dvl.occupied_m2;
      // Twists move the end point about the map's origin.
      add_match(found->information, match, end_point_m, registration.point_weight,
                [&](const Eigen::Vector2d&) { return weight; });
    });
    const Eigen::Vector3d off = twist_between(keyframe.pose, pose);
    for (const Met& of : met) {
      const double tempered = registration.gamma / matches;
      const Eigen::Matrix3d information = tempered * of.information.matrix;
      const Eigen::Vector3d measured = drift_between(of.piece, piece, of_age.drift) + off;
      graph_.add_link(of.piece, piece, information, information * measured + tempered * of.information.vector);
    }
  }

  /// How far two poses are from each other, and what is seen 5 m away from them.
  [[nodiscard]] static double shift_m(const Pose2& a, const Pose2& b) {
    return distance(a.position(), b.position()) + 5.0 * std::abs(angle_between_rad(a.yaw_rad, b.yaw_rad));
  }

  [[nodiscard]] static Eigen::Vector3d drift_between(int from, int to, const MapDrift& drift) {
    return drift.twist(to) - drift.twist(from);
  }

  static constexpr int age_iterations = 4;
  static constexpr double jump_mahalanobis2_max = 11.3;  ///< what drift exceeds once in a hundred times, in three dimensions

  Params params_;
  DriftGraph graph_;
  KeptScans kept_;
  Eigen::Matrix3d step_covariance_ = Eigen::Matrix3d::Zero();  // of twists, since the last piece was born
  Eigen::Vector3d step_jump_ = Eigen::Vector3d::Zero();
  int solved_at_ = 0;  // by the youngest piece of then
  bool is_solution_due_ = false;
  bool is_redraw_due_ = false;
  int redraws_ = 0;
};

/// The filter that closes loops.
using LoopClosingDvlEkf = BasicDvlEkf<2, LoopClosure>;

}  // namespace incognita
