/// The extended Kalman filter that weighs each hit by the map's confidence (Seo et al., section IV-B).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "incognita/estimation/compass.hpp"
#include "incognita/estimation/correlative_search.hpp"
#include "incognita/estimation/estimator.hpp"
#include "incognita/estimation/map_drift.hpp"
#include "incognita/estimation/registration.hpp"
#include "incognita/estimation/relocation.hpp"
#include "incognita/estimation/scan_consistency.hpp"
#include "incognita/estimation/surface_map.hpp"
#include "incognita/estimation/yaw_update.hpp"
#include "incognita/grid/traversal.hpp"

namespace incognita {

/// Loops that are not closed.
struct NoLoops {
  /// None.
  struct Params {
    void validate() const {}  ///< never throws

    /// For archives of states, see docs/mission_file.md: there are none.
    template <class Fields>
    void list_fields(Fields& /*fields*/) const {}
  };
  NoLoops() = default;                           ///< closes nothing
  explicit NoLoops(const Params& /*params*/) {}  ///< likewise

  /// For archives of states, see docs/mission_file.md: there is none.
  template <class Archive>
  void archive_state(Archive& /*archive*/, std::size_t /*pieces*/) {}
};

/// Prediction by (7); correction by the tempered likelihoods of (9) with R_x of (10). Form::registration (the default)
/// corrects position and heading against sub-cell surfaces. Form::ray is Lemma 4.1 to the letter, hits associated by
/// casting the beam in the belief: it does not observe the heading and drifts (reading: 1.5 m and more), so it is there
/// for comparison. Decisions are predicted with the ray form, whichever form estimates.
/// A template, so that who includes this header and does not use it does not pay for it; planar so far. Loops is what it
/// does when the robot returns to where it was: NoLoops, nothing beyond registering to the oldest surfaces; LoopClosure moves
/// the map, see loops/.
template <int Dim = 2, class Loops = NoLoops>
class BasicDvlEkf {
  static_assert(Dim == 2, "the filter is planar");
  static constexpr bool closes_loops = !std::is_same_v<Loops, NoLoops>;

 public:
  /// How a scan corrects.
  enum class Form {
    registration,  ///< to sub-cell surfaces
    ray            ///< Lemma 4.1 to the letter
  };

  /// All that the filter can be told; the defaults are for a planar LiDAR at 10 Hz.
  struct Params {
    PoseBelief start{{}, diagonal_covariance(1e-6, 1e-6, 1e-6)};  ///< in the map's frame
    /// Q of (7): 0.01 m and 0.01 rad a scan at 10 Hz. A few times the noise of usual odometry: errors of a map are
    /// correlated over scans, and a filter matched to the odometry grows sure of them.
    MotionNoise noise{0.0316, 0.0316};
    /// The start pose defines the map's frame, so it is known: it is held for this many scans, or until odometry says
    /// that the robot has left it, while the first surfaces are measured from a pose without error.
    int start_scans_held = 20;
    /// Driven from the start, by odometry: further, and the start is over; >= 0.
    double start_hold_distance_m = 0.1;
    double start_hold_turn_rad = 0.05;  ///< turned, likewise; >= 0
    Form form = Form::registration;     ///< of corrections
    /// false: the decoupled baseline A2, A4 of section VI-B. A hit counts with R_o alone where the cell is occupied
    /// with more than decoupled_probability_min, and not at all elsewhere.
    bool coupled = true;
    double decoupled_probability_min = 0.65;    ///< in [0, 1)
    RegistrationParams registration;            ///< for Form::registration
    typename SurfaceMap<Dim>::Params surfaces;  ///< that scans are registered to
    MapDrift::Params drift;                     ///< of the map
    typename Loops::Params loops;               ///< of what closes loops
    /// Whether headings are also measured by the building's dominant directions, where it has them.
    bool uses_compass = true;
    CompassParams compass;  ///< of the headings from walls
    /// Where odometry may be far off, search for the best place in search_window before each registration; else only when
    /// registration's result contradicts the map, or fits it worse than usual.
    bool searches_each_scan = false;
    SearchWindow search_window{0.3, 0.3, 0.21};  ///< how far off odometry may be, each way
    CorrelativeSearchParams search;              ///< for that place
    /// What tells a wrong pose from a new place.
    ConsistencyParams consistency;
    RelocationParams relocation;  ///< of a robot that was carried off
    int lost_scans = 10;          ///< lost after so many scans in a row that contradict the map, >= 1
    RayUpdateParams ray;          ///< for Form::ray
    /// For imagined scans: divided by the number of beams, so that little is learned where little is seen.
    RayUpdateParams imagined{{}, 1.2, Tempering::beams, MixtureVariance::squared_weights};

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Fields>
    void list_fields(Fields& fields) const {
      fields(
          "start, noise, start_scans_held, start_hold_distance_m, start_hold_turn_rad, form, coupled, decoupled_probability_min, "
          "registration, surfaces, drift, loops, uses_compass, compass, searches_each_scan, search_window, search, consistency, "
          "relocation, lost_scans, ray, imagined",
          start, noise, start_scans_held, start_hold_distance_m, start_hold_turn_rad, form, coupled, decoupled_probability_min, registration,
          surfaces, drift, loops, uses_compass, compass, searches_each_scan, search_window, search, consistency, relocation, lost_scans, ray,
          imagined);
    }
  };

  /// With the default parameters.
  BasicDvlEkf() : BasicDvlEkf(Params{}) {}

  /// Throws std::invalid_argument for parameters outside of their bounds; the noise must be > 0.
  explicit BasicDvlEkf(const Params& params)
      : params_(params),
        belief_(params.start),
        in_map_(params.start.covariance),
        driven_(params.start),
        surfaces_(params.surfaces),
        drift_(params.drift),
        compass_(params.compass),
        search_(params.search),
        relocation_(params.relocation),
        loops_(params.loops) {
    require_belief("DvlEkf", params.start);
    require_positive("DvlEkf", "noise.position_m_per_sqrt_s", params.noise.position_m_per_sqrt_s);
    require_positive("DvlEkf", "noise.yaw_rad_per_sqrt_s", params.noise.yaw_rad_per_sqrt_s);
    require(params.start_scans_held >= 0, "DvlEkf", "start_scans_held", params.start_scans_held, ">= 0");
    require_non_negative("DvlEkf", "start_hold_distance_m", params.start_hold_distance_m);
    require_non_negative("DvlEkf", "start_hold_turn_rad", params.start_hold_turn_rad);
    require(params.decoupled_probability_min >= 0.0 && params.decoupled_probability_min < 1.0, "DvlEkf",
            "decoupled_probability_min", params.decoupled_probability_min, "in [0, 1)");
    require(params.lost_scans >= 1, "DvlEkf", "lost_scans", params.lost_scans, ">= 1");
    params.registration.validate();
    params.search_window.validate();
    params.consistency.validate();
    params.ray.validate();
    params.imagined.validate();
    if (!params.coupled) decouple(params_);
  }

  [[nodiscard]] const Params& params() const { return params_; }  ///< as given, decoupled where that was asked for
  [[nodiscard]] const PoseBelief& belief() const { return belief_; }  ///< in the map's frame
  [[nodiscard]] const SurfaceMap<Dim>& surfaces() const { return surfaces_; }  ///< learned so far, in the map's frame

  /// The part of belief() that is the drift of the map around; the rest is the uncertainty in that map.
  [[nodiscard]] const MapDrift& drift() const { return drift_; }

  [[nodiscard]] const Loops& loops() const { return loops_; }  ///< what closes loops
  [[nodiscard]] Loops& loops() { return loops_; }  ///< for who draws the map again, see Slam

  /// False while the start pose is held.
  [[nodiscard]] bool is_ready() const { return scans_held_ >= params_.start_scans_held; }

  /// Throws std::invalid_argument unless the increment is finite and the duration finite and >= 0.
  void predict(const Pose2& increment, double duration_s) {
    require_motion("DvlEkf::predict", increment, duration_s);
    believe(propagate({belief_.pose, in_map_}, increment, params_.noise, duration_s));
    if constexpr (closes_loops) loops_.add_motion(params_.noise.covariance(duration_s), belief_.pose.position());
    if (is_ready()) {
      relocation_.elapse(duration_s);
    } else {
      driven_ = propagate(driven_, increment, params_.noise, duration_s);
    }
  }

  /// Corrects the belief by a scan; `map` must not have taken the scan yet.
  template <class MapType>
  CorrectionReport correct(const Scan<Dim>& scan, const MapType& map) {
    if (!is_ready()) {
      if (stands_at_start()) {
        ++scans_held_;
        believe(params_.start);
        if (params_.uses_compass) (void)compass_.measure(scan, belief_.pose.yaw_rad);
        return {};
      }
      scans_held_ = params_.start_scans_held;
      believe(driven_);
    }
    return params_.form == Form::registration ? correct_by_registration(scan, map) : correct_by_rays(scan, map);
  }

  /// Adds the scan's end points, seen from the belief, to the surfaces.
  void learn(const Scan<Dim>& scan) {
    if (params_.form != Form::registration) return;
    const std::size_t pieces_before = drift_.size();
    const int piece = drift_.piece_of_scan(in_map_, belief_.pose.position());
    if constexpr (closes_loops) {
      if (drift_.size() > pieces_before) {
        const auto moved = loops_.add_keyframe({scan, belief_.pose, heading_}, params_.registration, surfaces_, drift_);
        believe({moved_pose(belief_.pose, moved), in_map_});
      }
      loops_.keep(scan, belief_, piece, drift_);
      heading_.reset();
    }
    const Eigen::Matrix2d rotation = belief_.pose.rotation();
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.reading(beam) != Reading::hit) continue;
      const Eigen::Vector2d direction = rotation * scan.direction(beam);
      surfaces_.add(belief_.pose.position() + direction * scan.range_m(beam), direction, piece,
                    [this](int of, const Eigen::Vector2d& at_m) { return drift_.shift_m(of, at_m); });
    }
    surfaces_.refresh_normals();
  }

  /// A heading measured directly (a compass, the paper's orientation aid of 0.01 rad): a scalar update.
  /// Throws std::invalid_argument unless yaw_rad is finite and sigma_rad > 0.
  void correct_heading(double yaw_rad, double sigma_rad) {
    require(std::isfinite(yaw_rad), "DvlEkf::correct_heading", "yaw_rad", yaw_rad, "finite");
    require_positive("DvlEkf::correct_heading", "sigma_rad", sigma_rad);
    const double variance_rad2 = sigma_rad * sigma_rad;
    const Eigen::Matrix3d prior = belief_.covariance;
    const double off_rad = angle_between_rad(belief_.pose.yaw_rad, yaw_rad);
    const double turn_rad = off_rad / (prior(2, 2) + variance_rad2);
    const Pose2 pose{belief_.pose.x_m + prior(0, 2) * turn_rad, belief_.pose.y_m + prior(1, 2) * turn_rad,
                     wrap_angle_rad(belief_.pose.yaw_rad + prior(2, 2) * turn_rad)};
    // Both parts of the covariance learn from it, each taking the other for noise. The map around turns with its drift.
    const double in_map_rad2 = in_map_(2, 2);
    const Eigen::Matrix3d in_map = yaw_updated_covariance(in_map_, drift_.covariance()(2, 2) + variance_rad2);
    (void)drift_.correct_turn(off_rad, in_map_rad2 + variance_rad2);
    believe({pose, in_map});
    heading_ = {yaw_rad, variance_rad2};
  }

  /// The belief after a motion that was not driven: (7). Checks nothing.
  [[nodiscard]] PoseBelief imagine_motion(const PoseBelief& belief, const Pose2& increment, double duration_s) const {
    return propagate(belief, increment, params_.noise, duration_s);
  }

  /// The belief after scan_count scans like the one whose hits are given, without knowing their residuals: (11a).
  [[nodiscard]] PoseBelief imagine_scan(const PoseBelief& belief, std::span<const RayObservation> hits,
                                        std::size_t beam_count, double scan_count) const {
    RayUpdateParams params = params_.imagined;
    params.gamma *= scan_count;
    return {belief.pose, updated_covariance(belief.covariance, ray_information(hits, beam_count, params).matrix)};
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("filter", params_);
    archive(belief_, in_map_, driven_, drift_);
    surfaces_.archive_state(archive, drift_.size());
    archive(compass_, relocation_);
    loops_.archive_state(archive, drift_.size());
    archive(heading_, scans_held_);
    archive.require(belief_.pose.is_finite() && driven_.pose.is_finite(), "a pose is not finite");
    archive.require(scans_held_ >= 0 && scans_held_ <= params_.start_scans_held, "too many scans were held at the start");
  }

 private:
  /// R_o whatever the probability: (10) with both variances weighed as if the cell were certain.
  static void decouple(Params& params) {
    params.registration.mixture = MixtureVariance::occupied_only;
    params.ray.mixture = MixtureVariance::occupied_only;
    params.imagined.mixture = MixtureVariance::occupied_only;
  }

  [[nodiscard]] bool stands_at_start() const {
    const Pose2& start = params_.start.pose;
    return distance(driven_.pose.position(), start.position()) <= params_.start_hold_distance_m &&
           std::abs(angle_between_rad(start.yaw_rad, driven_.pose.yaw_rad)) <= params_.start_hold_turn_rad;
  }

  /// What register_scan asks of the surfaces.
  template <class MapType>
  struct SurfacesInMap : CertainSurfaces {
    SurfacesInMap(const BasicDvlEkf& of_filter, const MapType& in_map) : filter(of_filter), map(in_map) {}

    const BasicDvlEkf& filter;
    const MapType& map;

    [[nodiscard]] double occupied_probability(const Surface<Dim>& surface) const {
      // The belief's hits lie a little behind the measured face, so look there too.
      const Eigen::Vector2d face_m = sum(surface.mean_m, shift_m(surface, surface.mean_m));
      const double at_face = map.probability(map.lattice().index_of(face_m));
      const double behind = map.probability(map.lattice().index_of(sum(face_m, scaled(surface.view, 0.1))));
      return filter.admitted(std::max(at_face, behind));
    }
    [[nodiscard]] double excess_variance_m2(const Surface<Dim>& surface, const Eigen::Vector3d& jacobian) const {
      return filter.drift_.variance_beyond_reference_m2(surface.piece, jacobian);
    }
    [[nodiscard]] Eigen::Vector2d shift_m(const Surface<Dim>& surface, const Eigen::Vector2d& at_m) const {
      return filter.drift_.shift_m(surface.piece, at_m);
    }
  };

  /// The pose, with its covariance in the map around.
  void believe(const PoseBelief& in_map) {
    in_map_ = in_map.covariance;
    belief_ = in_map;
    add_to(belief_.covariance, drift_.covariance_at(in_map.pose.position()));
  }

  void correct_by_compass(const Scan<Dim>& scan) {
    const auto heading = compass_.measure(scan, belief_.pose.yaw_rad);
    if (heading) correct_heading(heading->yaw_rad, std::sqrt(heading->variance_rad2));
  }

  /// Registers to the oldest surfaces in sight from now on. A few beams are enough to tell which.
  template <class SurfaceBelief>
  void choose_reference(const Scan<Dim>& scan, const SurfaceBelief& surface_belief) {
    const Eigen::Vector2d origin = belief_.pose.position();
    const Eigen::Matrix2d rotation = belief_.pose.rotation();
    drift_.begin_matches(origin);
    for (std::size_t beam = 0; beam < scan.size(); beam += reference_stride) {
      if (scan.reading(beam) != Reading::hit) continue;
      const Eigen::Vector2d direction = product(rotation, scan.direction(beam));
      const Eigen::Vector2d end_point_m = sum(origin, scaled(direction, scan.range_m(beam)));
      const SurfaceMatch match = match_surface(surfaces_, end_point_m, direction, params_.registration, surface_belief);
      if (match.surface == nullptr || surface_belief.occupied_probability(*match.surface) < 0.0) continue;
      drift_.add_match(match.surface->piece);
    }
    const int before = drift_.reference().piece;
    add_to(in_map_, drift_.choose_reference());
    if constexpr (closes_loops) {
      if (loops_.is_return(before, drift_.reference().piece)) drift_.begin_piece();
    }
  }

  template <class MapType>
  CorrectionReport correct_by_registration(const Scan<Dim>& scan, const MapType& map) {
    const SurfacesInMap<MapType> surface_belief(*this, map);
    const PoseBelief predicted{belief_.pose, in_map_};
    const MapDrift::Reference reference = drift_.reference();
    if (params_.searches_each_scan) {
      const auto& candidates = search_.find(scan, surfaces_, predicted, params_.search_window);
      if (!candidates.empty()) believe({candidates.front().pose, in_map_});
    }
    if (params_.uses_compass && relocation_.doubtful_scans() == 0) correct_by_compass(scan);
    choose_reference(scan, surface_belief);
    const auto fit_from = [&](const PoseBelief& start, const RegistrationParams& params, std::size_t beams_max) {
      ConsistencyParams consistency = params_.consistency;
      consistency.beams_max = beams_max;
      const Registration found = register_scan(start, scan, surfaces_, params, surface_belief);
      return ScanFit{found, scan_consistency(map, scan, found.belief.pose, consistency)};
    };
    ScanFit fit = fit_from({belief_.pose, in_map_}, params_.registration, params_.consistency.beams_max);
    CorrectionReport report;
    report.trusted = fit.consistency.holds(params_.consistency);
    relocation_.judge(fit.consistency, !report.trusted, params_.consistency.beams_min);
    if (relocation_.must_search(!params_.searches_each_scan)) {
      report.relocated = relocate(scan, map, predicted.pose, fit, fit_from);
      report.trusted = report.trusted || report.relocated;
    }
    report.consistent_share = fit.consistency.share();
    if (!report.trusted) {
      drift_.restore(reference);
      believe(predicted);
      heading_.reset();
      report.lost = relocation_.doubtful_scans() >= params_.lost_scans;
      return report;
    }
    relocation_.add_usual(fit, params_.consistency.beams_min);
    report.associations = fit.registration.associations;
    report.residual_rms_m = fit.registration.residual_rms_m;
    believe(fit.registration.belief);
    return report;
  }

  /// Looks for a place where the scan fits better, judging by all beams, and makes `fit` the fit there. Returns whether there
  /// is one. fit_from(belief, registration params, beams_max) fits the scan from a belief.
  template <class MapType, class FitFrom>
  bool relocate(const Scan<Dim>& scan, const MapType& map, const Pose2& predicted, ScanFit& fit, const FitFrom& fit_from) {
    ConsistencyParams all_beams = params_.consistency;
    all_beams.beams_max = scan.size();
    const std::size_t judged_min =
        params_.consistency.beams_min * std::max<std::size_t>(1, scan.size() / params_.consistency.beams_max);
    const bool is_contradicted = relocation_.doubtful_scans() > 0;
    fit.consistency = scan_consistency(map, scan, fit.registration.belief.pose, all_beams);
    if (!is_contradicted && !relocation_.is_unusual(fit.consistency, judged_min)) return false;
    RegistrationParams params = params_.registration;
    params.iterations = relocation_iterations;
    const SearchWindow window = relocation_.begin_search();
    const bool is_found = relocation_.improve(
        fit, search_.find(scan, surfaces_, predicted, window), is_contradicted, judged_min,
        [&](const SearchCandidate& candidate) {
          return fit_from({candidate.pose, diagonal_covariance(0.01, 0.01, 0.0025)}, params, scan.size());
        });
    if (!is_found) return false;
    if constexpr (closes_loops) {
      if (loops_.add_jump({predicted, belief_.covariance}, fit.registration.belief)) drift_.begin_piece();
    }
    heading_.reset();  // it was heard elsewhere
    relocation_.reset();
    return true;
  }

  template <class MapType>
  CorrectionReport correct_by_rays(const Scan<Dim>& scan, const MapType& map) {
    std::vector<RayObservation> hits;
    const Eigen::Vector2d origin = belief_.pose.position();
    const Eigen::Matrix2d rotation = belief_.pose.rotation();
    double squares_m2 = 0.0;
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.reading(beam) != Reading::hit) continue;
      const double range_m = scan.range_m(beam) + map.hit_push_m();
      const Eigen::Vector2d end = sum(origin, scaled(product(rotation, scan.direction(beam)), range_m + ray_search_m));
      traverse<2>(map.lattice(), origin, end, [&](const Index<2>& index) {
        const double probability = map.probability(index);
        if (probability <= 0.5) return true;
        const Eigen::Vector2d to_cell = difference(map.lattice().center_m(index), origin);
        const double distance_m = norm(to_cell);
        if (distance_m <= 0.0 || admitted(probability) < 0.0) return false;
        hits.push_back({{to_cell[0] / distance_m, to_cell[1] / distance_m}, range_m - distance_m, probability});
        squares_m2 += (range_m - distance_m) * (range_m - distance_m);
        return false;
      });
    }
    if (hits.empty()) return {};
    believe(ray_update({belief_.pose, in_map_}, hits, scan.size(), params_.ray));
    return {hits.size(), std::sqrt(squares_m2 / static_cast<double>(hits.size()))};
  }

  /// The probability a hit counts with; negative where the decoupled filter leaves it out.
  [[nodiscard]] double admitted(double probability) const {
    return params_.coupled || probability > params_.decoupled_probability_min ? probability : -1.0;
  }

  static constexpr std::size_t reference_stride = 4;  ///< beams
  static constexpr int relocation_iterations = 8;
  static constexpr double ray_search_m = 1.0;  ///< how far behind a reading its cell may lie

  Params params_;
  PoseBelief belief_;
  Eigen::Matrix3d in_map_;  ///< the covariance of belief_ without the map's drift
  PoseBelief driven_;  ///< by odometry alone, since the start, until ready
  SurfaceMap<Dim> surfaces_;
  MapDrift drift_;
  Compass compass_;
  CorrelativeSearch<Dim> search_;
  Relocation relocation_;
  Loops loops_;
  std::optional<Compass::Heading> heading_;  ///< measured since the last scan that was learned
  int scans_held_ = 0;
};

/// The filter without loops.
using DvlEkf = BasicDvlEkf<2>;

}  // namespace incognita
