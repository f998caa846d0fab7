/// Another place for a robot whose scan does not fit the map where it believes to be.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <type_traits>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/estimation/correlative_search.hpp"
#include "incognita/estimation/registration.hpp"
#include "incognita/estimation/scan_consistency.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// Parameters of Relocation.
struct RelocationParams {
  double share_min = 0.8;        ///< of the judged beams that must agree with the map at a new place, in (0, 1]
  double share_margin = 0.12;    ///< two places whose shares are this near to each other are equally good, > 0
  /// A new place's residual is at most so many times the usual one, or no larger than the old place's: among rows of equal
  /// rooms the share alone has moved a robot that was right into a room that was not.
  double residual_ratio_max = 1.5;
  double separation_m = 0.3;     ///< places further apart than this are different ones, >= 0
  double memory_scans = 50;      ///< over how many scans it is learned what is usual, without a unit, >= 1

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require(share_min > 0.0 && share_min <= 1.0, "RelocationParams", "share_min", share_min, "in (0, 1]");
    require_positive("RelocationParams", "share_margin", share_margin);
    require_positive("RelocationParams", "residual_ratio_max", residual_ratio_max);
    require_non_negative("RelocationParams", "separation_m", separation_m);
    require(memory_scans >= 1.0, "RelocationParams", "memory_scans", memory_scans, ">= 1");
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "share_min, share_margin, residual_ratio_max, separation_m, memory_scans",
        share_min, share_margin, residual_ratio_max, separation_m, memory_scans);
  }
};

/// How well a scan fits a map at a place: what registration made of it there, and what the belief says to that.
struct ScanFit {
  Registration registration;    ///< there
  ScanConsistency consistency;  ///< with the belief
};

/// How long something has held without a break.
struct Streak {
  int scans = 0;            ///< in a row of which it held
  double duration_s = 0.0;  ///< since the last scan of which it did not hold: one period of the scanner at least

  /// Counts a scan, or starts over. The time is added by who knows it.
  void note(bool holds) {
    scans = holds ? scans + 1 : 0;
    if (!holds) duration_s = 0.0;
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(scans, duration_s);
  }
};

/// Learns how well scans usually fit, and judges by that whether and where to look for the robot elsewhere, and whether it is
/// better believed to be there. Fits with fewer judged beams than `judged_min` say nothing. Not thread safe.
class Relocation {
 public:
  /// How far a robot may have been carried off.
  static constexpr double carried_m = 3.5;

  /// Throws std::invalid_argument for parameters outside of their bounds.
  explicit Relocation(const RelocationParams& params = {}) : params_(params) { params_.validate(); }

  /// Time passes until the next scan.
  void elapse(double duration_s) {
    doubtful_.duration_s += duration_s;
    unusual_.duration_s += duration_s;
  }

  /// Notes whether the map contradicts a scan.
  void judge(const ScanConsistency& seen, bool is_contradicted, std::size_t judged_min) {
    doubtful_.note(is_contradicted);
    unusual_.note(is_contradicted || is_unusual(seen, judged_min));
    ++scans_since_search_;
  }

  /// The scans in a row that the map contradicts.
  [[nodiscard]] int doubtful_scans() const { return doubtful_.scans; }

  /// Whether to look elsewhere, for unusual scans also when the map does not contradict them. Not at once: somebody who
  /// passes before the scanner is gone after a few scans or a moment, a robot that was carried off stays so.
  [[nodiscard]] bool must_search(bool for_unusual_scans) const {
    if (doubtful_.scans > 0) return doubtful_.scans >= doubtful_patience_scans || doubtful_.duration_s >= doubtful_patience_s;
    return for_unusual_scans && scans_since_search_ >= unusual_search_every &&
           (unusual_.scans >= unusual_patience_scans || (unusual_.scans > 0 && unusual_.duration_s >= unusual_patience_s));
  }

  /// Where to look around the predicted pose: near its heading, and all around at every fifth doubtful scan, which for a fast
  /// scanner is the first search.
  [[nodiscard]] SearchWindow begin_search() {
    scans_since_search_ = 0;
    if (doubtful_.scans == 0) return {slipped_m, slipped_m, turned_rad};
    return {carried_m, carried_m, doubtful_.scans % wide_search_every == 0 ? std::numbers::pi : turned_rad};
  }

  /// Scans from here on are taken somewhere else.
  void reset() {
    doubtful_.note(false);
    unusual_.note(false);
  }

  /// Learns from the fit of a scan that was trusted.
  void add_usual(const ScanFit& fit, std::size_t judged_min) {
    if (fit.consistency.judged() < judged_min || fit.registration.associations == 0) return;
    usual_share_ += (fit.consistency.share() - usual_share_) / params_.memory_scans;
    usual_residual_m_ += (fit.registration.residual_rms_m - usual_residual_m_) / params_.memory_scans;
  }

  /// Whether fewer of a scan's beams agree with the map than usually do: a corridor looks much the same a metre further, so
  /// the map need not contradict a scan that was taken there.
  [[nodiscard]] bool is_unusual(const ScanConsistency& seen, std::size_t judged_min) const {
    return seen.judged() >= judged_min && seen.share() < usual_share_ - params_.share_margin;
  }

  /// Makes `fit` the best of the candidates' fits, if that is better: more of the beams agree, by a margin and by what is
  /// usual (when the map contradicts the current place: by share_min), and residuals are as small. Returns false and leaves
  /// it when there is none, or when one elsewhere is as good. fit_at(candidate) gives a candidate's fit.
  template <class FitAt>
  [[nodiscard]] bool improve(ScanFit& fit, const std::vector<SearchCandidate>& candidates, bool is_contradicted, std::size_t judged_min,
               FitAt&& fit_at) const {
    const double share_min =
        std::max(is_contradicted ? params_.share_min : usual_share_, fit.consistency.share() + params_.share_margin);
    const double residual_max_m =
        std::max(fit.registration.residual_rms_m, params_.residual_ratio_max * usual_residual_m_);
    std::vector<std::decay_t<decltype(fit_at(candidates.front()))>> fits;  // ScanFits, which only users pay for
    std::size_t best = 0;
    for (const SearchCandidate& candidate : candidates) {
      const auto found = fit_at(candidate);
      if (found.registration.associations == 0 || found.registration.residual_rms_m > residual_max_m) continue;
      if (found.consistency.agreeing < judged_min || found.consistency.share() < share_min) continue;
      fits.push_back(found);
      if (found.consistency.share() > fits[best].consistency.share()) best = fits.size() - 1;
    }
    for (const auto& found : fits) {
      const bool is_as_good = found.consistency.share() > fits[best].consistency.share() - params_.share_margin;
      if (is_as_good && is_elsewhere(found, fits[best])) return false;
    }
    if (fits.empty()) return false;
    fit = fits[best];
    return true;
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("relocation", params_);
    archive(usual_share_, usual_residual_m_, doubtful_, unusual_, scans_since_search_);
  }

 private:
  [[nodiscard]] bool is_elsewhere(const ScanFit& one, const ScanFit& other) const {
    const Eigen::Vector2d other_m = other.registration.belief.pose.position();
    return distance(one.registration.belief.pose.position(), other_m) > params_.separation_m;
  }

  static constexpr int unusual_patience_scans = 3;  ///< in a row ...
  static constexpr double unusual_patience_s = 0.25;
  static constexpr int doubtful_patience_scans = 5;
  static constexpr double doubtful_patience_s = 0.45;  ///< ... of a scanner at 10 Hz; below 2 Hz one scan is enough
  static constexpr int unusual_search_every = 10;      ///< scans
  static constexpr int wide_search_every = 5;          ///< doubtful scans
  static constexpr double slipped_m = 1.2;             ///< how far wheels may have slipped ...
  static constexpr double turned_rad = 0.6;            ///< ... or the robot may have turned by them

  RelocationParams params_;
  double usual_share_ = 0.8;
  double usual_residual_m_ = 0.02;
  Streak doubtful_;
  Streak unusual_;  ///< doubtful scans count too
  int scans_since_search_ = 0;
};

}  // namespace incognita
