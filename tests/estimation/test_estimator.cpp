#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/testing/estimator_laws.hpp"

using namespace incognita;

namespace {

static_assert(Estimator<DvlEkf>);
static_assert(Estimator<DeadReckoning>);
static_assert(Estimator<DvlEkf, Map<LogOdds>>);
static_assert(Estimator<DeadReckoning, Map<LogOdds>>);

// What is none: each breaks one requirement of DeadReckoning, and that one alone.
struct NeverReady : DeadReckoning {
  int is_ready() const { return 0; }
};
static_assert(!Estimator<NeverReady>);
struct BeliefByValue : DeadReckoning {
  PoseBelief belief() const { return {}; }
};
static_assert(!Estimator<BeliefByValue>);
struct AnswersPredictions : DeadReckoning {
  bool predict(const Pose2&, double) { return true; }
};
static_assert(!Estimator<AnswersPredictions>);
struct CorrectsWithoutMap : DeadReckoning {
  CorrectionReport correct(const Scan<2>&) { return {}; }
};
static_assert(!Estimator<CorrectsWithoutMap>);
struct TakesOtherMaps : DeadReckoning {
  CorrectionReport correct(const Scan<2>&, const Map<LogOdds>&) { return {}; }
};
static_assert(!Estimator<TakesOtherMaps>);
static_assert(Estimator<TakesOtherMaps, Map<LogOdds>>);
struct ChangesWhenItImagines : DeadReckoning {
  PoseBelief imagine_motion(const PoseBelief& belief, const Pose2&, double) { return belief; }
};
static_assert(!Estimator<ChangesWhenItImagines>);
struct ImaginesNoScan : DeadReckoning {
  void imagine_scan() const {}
};
static_assert(!Estimator<ImaginesNoScan>);
struct LearnsNothing : DeadReckoning {
  void learn(const Scan<2>&) = delete;
};
static_assert(!Estimator<LearnsNothing>);
struct CannotBeCopied : DeadReckoning {
  std::unique_ptr<int> owned;
};
static_assert(!Estimator<CannotBeCopied>);
static_assert(!Estimator<PoseBelief>);
static_assert(!std::is_convertible_v<DvlEkf::Params, DvlEkf>);

/// Dead reckoning of one's own, with one law at a time broken.
struct Wrong {
  PoseBelief state;
  const PoseBelief& belief() const { return state; }
  bool is_ready() const { return true; }
  void predict(const Pose2& increment, double duration_s) {
    state = imagine_motion(state, increment, duration_s);
  }
  template <class MapType>
  CorrectionReport correct(const Scan<2>&, const MapType&) {
    return {};
  }
  void learn(const Scan<2>&) {}
  PoseBelief imagine_motion(const PoseBelief& belief, const Pose2& increment, double duration_s) const {
    return propagate(belief, increment, {0.1, 0.1}, duration_s);
  }
  PoseBelief imagine_scan(const PoseBelief& belief, std::span<const RayObservation>, std::size_t,
                          double) const {
    return belief;
  }
};
struct StartsWithoutCovariance : Wrong {
  StartsWithoutCovariance() { state.covariance(0, 0) = -1.0; }
};
struct NeverStarts : Wrong {
  bool is_ready() const { return false; }
};
struct NotSymmetric : Wrong {
  void predict(const Pose2& increment, double duration_s) {
    Wrong::predict(increment, duration_s);
    state.covariance(0, 1) += 1e-3;
  }
};
struct TooSure : Wrong {
  template <class MapType>
  CorrectionReport correct(const Scan<2>&, const MapType&) {
    state.covariance -= 2e-3 * Eigen::Matrix3d::Identity();
    return {};
  }
};
struct TurnsFirst : Wrong {
  void predict(const Pose2& increment, double duration_s) {
    Wrong::predict({0.0, 0.0, increment.yaw_rad}, duration_s);
    Wrong::predict({increment.x_m, increment.y_m, 0.0}, 0.0);
  }
};
struct ShrinksAtRest : Wrong {
  void predict(const Pose2& increment, double duration_s) {
    const Eigen::Matrix3d before = state.covariance;
    Wrong::predict(increment, duration_s);
    if (increment.position().norm() == 0.0) state.covariance = 0.9 * before;
  }
};
struct DrawsAtRandom : Wrong {
  void learn(const Scan<2>&) { state.pose.x_m += 1e-9 * static_cast<double>(++*calls); }
  std::shared_ptr<int> calls = std::make_shared<int>(0);
};
struct SeesNothingAsSomething : Wrong {
  template <class MapType>
  CorrectionReport correct(const Scan<2>&, const MapType&) {
    state.covariance *= 0.99;
    return {};
  }
};
struct CountsBeamsWithoutHits : Wrong {
  template <class MapType>
  CorrectionReport correct(const Scan<2>& scan, const MapType&) {
    return {scan.size(), 0.0};
  }
};
struct ImaginesInTheWrongFrame : Wrong {
  PoseBelief imagine_motion(const PoseBelief& belief, const Pose2& increment, double duration_s) const {
    PoseBelief next = propagate(belief, increment, {0.1, 0.1}, duration_s);
    next.pose.x_m = belief.pose.x_m + increment.x_m;
    return next;
  }
  void predict(const Pose2& increment, double duration_s) {
    state = Wrong::imagine_motion(state, increment, duration_s);
  }
};
struct ScansAddVariance : Wrong {
  PoseBelief imagine_scan(const PoseBelief& belief, std::span<const RayObservation> hits, std::size_t,
                          double) const {
    PoseBelief seen = belief;
    if (!hits.empty()) seen.covariance(2, 2) += 1e-3;
    return seen;
  }
};
struct LearnsFromNoHits : Wrong {
  PoseBelief imagine_scan(const PoseBelief& belief, std::span<const RayObservation>, std::size_t,
                          double) const {
    return {belief.pose, 0.5 * belief.covariance};
  }
};

template <class Filter>
bool breaks(const std::string& law) {
  static_assert(Estimator<Filter>);
  return check_estimator_laws(Filter{}).text().find(law) != std::string::npos;
}

}  // namespace

TEST_CASE("The estimators keep the laws", "[estimation]") {
  CHECK(check_estimator_laws(DeadReckoning()).text() == "");
  CHECK(check_estimator_laws(DvlEkf()).text() == "");
  DvlEkf::Params params;
  params.start = {{3.0, -4.0, 2.0}, 0.01 * Eigen::Matrix3d::Identity()};
  params.start_scans_held = 0;
  CHECK(check_estimator_laws(DvlEkf(params)).text() == "");
  params.form = DvlEkf::Form::ray;
  CHECK(check_estimator_laws(DvlEkf(params)).text() == "");
  params.form = DvlEkf::Form::registration;
  params.coupled = false;
  CHECK(check_estimator_laws(DvlEkf(params)).text() == "");
}

TEST_CASE("A user's estimator passes the check of the laws", "[estimation]") {
  CHECK(check_estimator_laws(Wrong{}).text() == "");
}

TEST_CASE("The check of the laws catches a wrong estimator", "[estimation]") {
  CHECK(breaks<StartsWithoutCovariance>("the covariance of a new estimator"));
  CHECK(breaks<NeverStarts>("ready after 1000 scans"));
  CHECK(breaks<NotSymmetric>("the covariance stays symmetric and positive semi-definite"));
  CHECK(breaks<TooSure>("the covariance stays symmetric and positive semi-definite"));
  CHECK(breaks<DrawsAtRandom>("equal calls give equal beliefs"));
  CHECK(breaks<TurnsFirst>("predict composes the pose with the increment"));
  CHECK(breaks<ShrinksAtRest>("predict does not reduce the covariance of a robot that stands"));
  CHECK(breaks<ImaginesInTheWrongFrame>("imagine_motion composes the pose with the increment"));
  CHECK(breaks<ScansAddVariance>("imagine_scan never adds variance"));
  CHECK(breaks<LearnsFromNoHits>("imagine_scan without hits leaves the covariance as it is"));
  CHECK(breaks<SeesNothingAsSomething>("a scan without hits leaves pose and covariance as they are"));
  CHECK(breaks<CountsBeamsWithoutHits>("a scan without hits leaves pose and covariance as they are"));
}
