#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>

#include "incognita/estimation/pose_belief.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/cells/exact_pose.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/map/map.hpp"
#include "incognita/testing/cell_policy_laws.hpp"

using namespace incognita;

namespace {

template <class Cell>
concept can_be_exact = requires { typename ExactPose<Cell>; };

static_assert(ClearingPolicy<ExactPose<TBayes>> && PriorPolicy<ExactPose<TBayes>> && can_be_exact<LogOdds> && !can_be_exact<Dispersion>);

}  // namespace

TEST_CASE("Cells of exact poses keep the laws of cells", "[map]") {
  CHECK(check_cell_policy_laws(ExactPose<TBayes>()).text() == "");
  CHECK(check_cell_policy_laws(ExactPose<TBayes>(TBayes::literal_params())).text() == "");
  CHECK(check_cell_policy_laws(ExactPose<LogOdds>()).text() == "");
}

TEST_CASE("A map of exact poses is that of a pose without covariance", "[map]") {
  const Scan<2> scan = [] {
    Scan<2> of_beams(circular_beams(90, 10.0));
    for (std::size_t beam = 0; beam < of_beams.size(); ++beam) of_beams.set_range_m(beam, 2.0 + std::sin(0.3 * static_cast<double>(beam)));
    return of_beams;
  }();
  Map<ExactPose<TBayes>> exact;
  Map<TBayes> certain;
  Map<TBayes> uncertain;
  const Pose2 pose{0.13, 0.07, 0.4};
  const Eigen::Matrix3d covariance = diagonal_covariance(0.5, 0.3, 0.01);
  exact.update(scan, pose, covariance);
  certain.update(scan, pose, Eigen::Matrix3d::Zero());
  uncertain.update(scan, pose, covariance);
  REQUIRE(exact.grid().size() == certain.grid().size());
  bool differs = false;
  for (Offset offset = 0; offset < static_cast<Offset>(exact.grid().size()); ++offset) {
    REQUIRE(exact.log_odds(offset) == certain.log_odds(offset));
    differs = differs || exact.log_odds(offset) != uncertain.log_odds(offset);
  }
  CHECK(differs);
}
