#include "peers/mrpt_grid.hpp"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>

#include <numbers>
#include <optional>
#include <utility>

namespace benchmarks {

namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

constexpr double whole_turn_rad = 2.0 * std::numbers::pi;

/// Beams all around, the first along the robot's x axis.
CObservation2DRangeScan circular_scan(std::size_t beams, double aperture_rad, double range_max_m) {
  CObservation2DRangeScan scan;
  scan.resizeScan(beams);
  scan.aperture = static_cast<float>(aperture_rad);
  scan.rightToLeft = true;
  scan.sensorPose = CPose3D(0.0, 0.0, 0.0, 0.5 * aperture_rad, 0.0, 0.0);
  scan.maxRange = static_cast<float>(range_max_m);
  return scan;
}

COccupancyGridMap2D small_grid(double resolution_m, double range_max_m) {
  const auto side_m = static_cast<float>(resolution_m);
  COccupancyGridMap2D grid(-side_m, side_m, -side_m, side_m, side_m);
  grid.insertionOptions.wideningBeamsWithDistance = false;
  grid.insertionOptions.maxDistanceInsertion = static_cast<float>(range_max_m);
  return grid;
}

}  // namespace

struct MrptDrive::Data {
  std::vector<CObservation2DRangeScan> scans;
  std::vector<std::optional<const CPose3D>> poses;
  double range_max_m;
};

MrptDrive::MrptDrive(const std::vector<PlanarScan>& scans, double range_max_m)
    : data_(std::make_unique<Data>()) {
  data_->range_max_m = range_max_m;
  for (const PlanarScan& from : scans) {
    // A beam that met nothing becomes a valid reading beyond the largest distance of insertion: MRPT then
    // frees the way up to that distance and sets no end. An invalid one would be freed for half of it only.
    constexpr double beyond_m = 1.0;
    // The grid spaces beams by the aperture over their number.
    CObservation2DRangeScan to =
        circular_scan(from.ranges_m.size(), whole_turn_rad, range_max_m + 2.0 * beyond_m);
    for (std::size_t beam = 0; beam < from.ranges_m.size(); ++beam) {
      const bool is_clear = from.ranges_m[beam] >= range_max_m;
      to.setScanRange(beam, static_cast<float>(is_clear ? range_max_m + beyond_m : from.ranges_m[beam]));
      to.setScanRangeValidity(beam, true);
    }
    data_->scans.push_back(std::move(to));
    data_->poses.emplace_back(CPose3D(from.x_m, from.y_m, 0.0, from.yaw_rad, 0.0, 0.0));
  }
}

MrptDrive::~MrptDrive() = default;

std::size_t MrptDrive::size() const { return data_->scans.size(); }

std::int64_t MrptDrive::touches(std::size_t n, double resolution_m) const {
  // What a scan adds up to in the cells, a pass worth so many steps of their 8 bits, and a hit the same
  // whatever a pass is worth: the difference between two worths is the number of passes. Few beams at a time,
  // so that no cell overflows.
  constexpr std::size_t beams_at_once = 60;
  const int unknown = COccupancyGridMap2D::p2l(0.5F);
  const auto sum_of_changes = [&](const CObservation2DRangeScan& scan, int pass_worth) {
    float freeness = 0.5F;
    while (COccupancyGridMap2D::p2l(freeness) - unknown < pass_worth) freeness += 1e-4F;
    COccupancyGridMap2D cells = small_grid(resolution_m, data_->range_max_m);
    cells.insertionOptions.considerInvalidRangesAsFreeSpace = false;
    cells.insertionOptions.maxOccupancyUpdateCertainty = 0.5F;
    cells.insertionOptions.maxFreenessUpdateCertainty = freeness;
    cells.insertObservation(scan, data_->poses[n]);
    std::int64_t sum = 0;
    for (unsigned y = 0; y < cells.getSizeY(); ++y) {
      const COccupancyGridMap2D::cellType* const row = cells.getRow(static_cast<int>(y));
      for (unsigned x = 0; x < cells.getSizeX(); ++x) sum += row[x] - unknown;
    }
    return sum;
  };

  std::int64_t touches = 0;
  const std::size_t beams = data_->scans[n].getScanSize();
  for (std::size_t first = 0; first < beams; first += beams_at_once) {
    CObservation2DRangeScan part = data_->scans[n];
    for (std::size_t beam = 0; beam < beams; ++beam) {
      const bool is_used = beam >= first && beam < first + beams_at_once;
      part.setScanRangeValidity(beam, is_used);
      if (is_used && part.getScanRange(beam) < static_cast<float>(data_->range_max_m)) ++touches;  // its hit
    }
    touches += sum_of_changes(part, 2) - sum_of_changes(part, 1);
  }
  return touches;
}

struct MrptGrid::Data {
  COccupancyGridMap2D grid;
  CObservation2DRangeScan simulated;
};

MrptGrid::MrptGrid(double resolution_m, double range_max_m)
    : data_(std::make_unique<Data>(Data{small_grid(resolution_m, range_max_m), {}})) {}

MrptGrid::MrptGrid(double resolution_m, int width, int height, const std::vector<std::uint8_t>& walls)
    : data_(std::make_unique<Data>()) {
  const auto side_m = static_cast<float>(resolution_m);
  data_->grid.setSize(0.0F, static_cast<float>(width * resolution_m), 0.0F,
                      static_cast<float>(height * resolution_m), side_m);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      data_->grid.setCell(x, y, walls[at] != 0 ? 0.0F : 1.0F);
    }
  }
}

MrptGrid::MrptGrid(const MrptGrid& other) : data_(std::make_unique<Data>(*other.data_)) {}

MrptGrid::~MrptGrid() = default;

void MrptGrid::insert(const MrptDrive& drive, std::size_t n) {
  data_->grid.insertObservation(drive.data_->scans[n], drive.data_->poses[n]);
}

double MrptGrid::cast_ray_m(double x_m, double y_m, double direction_rad, double range_max_m) const {
  float range_m = 0.0F;
  bool is_valid = false;
  data_->grid.simulateScanRay(x_m, y_m, direction_rad, range_m, is_valid, range_max_m);
  return is_valid ? static_cast<double>(range_m) : range_max_m;
}

void MrptGrid::simulate_scan(double x_m, double y_m, double yaw_rad, std::size_t count, double range_max_m) {
  CObservation2DRangeScan& scan = data_->simulated;
  if (scan.getScanSize() != count || scan.maxRange != static_cast<float>(range_max_m)) {
    // The simulator's last beam lies at the aperture's end.
    const auto beams = static_cast<double>(count);
    scan = circular_scan(count, whole_turn_rad * (beams - 1.0) / beams, range_max_m);
  }
  data_->grid.laserScanSimulator(scan, CPose2D(x_m, y_m, yaw_rad), 0.5F, count);
}

double MrptGrid::simulated_m(std::size_t beam) const {
  const CObservation2DRangeScan& scan = data_->simulated;
  return static_cast<double>(scan.getScanRangeValidity(beam) ? scan.getScanRange(beam) : scan.maxRange);
}

}  // namespace benchmarks
