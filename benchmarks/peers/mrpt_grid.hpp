/// MRPT's occupancy grid behind plain types. Its headers decide how objects are aligned by the instructions
/// that are compiled for, so all that includes them is compiled as its library was, whatever the benchmarks'
/// own flags.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace benchmarks {

/// A scan by beams evenly around the sensor, the first along its x axis; a range of range_max_m met nothing.
struct PlanarScan {
  double x_m;
  double y_m;
  double yaw_rad;
  std::vector<double> ranges_m;
};

/// A recorded drive as MRPT's observations, made once, as a driver would.
class MrptDrive {
 public:
  MrptDrive(const std::vector<PlanarScan>& scans, double range_max_m);
  ~MrptDrive();
  MrptDrive(const MrptDrive&) = delete;
  MrptDrive& operator=(const MrptDrive&) = delete;

  [[nodiscard]] std::size_t size() const;

  /// How many cells all beams of the scan `n` touch, counted one by one by each beam, on a grid of that
  /// resolution.
  [[nodiscard]] std::int64_t touches(std::size_t n, double resolution_m) const;

 private:
  friend class MrptGrid;
  struct Data;
  std::unique_ptr<Data> data_;
};

/// COccupancyGridMap2D with rays that do not widen; all other insertion options but the range are its
/// defaults.
class MrptGrid {
 public:
  /// A grid of little extent, which grows.
  MrptGrid(double resolution_m, double range_max_m);

  /// A building from (0, 0), width x height cells, x fastest; 0 is free.
  MrptGrid(double resolution_m, int width, int height, const std::vector<std::uint8_t>& walls);

  MrptGrid(const MrptGrid& other);
  MrptGrid& operator=(const MrptGrid&) = delete;
  ~MrptGrid();

  void insert(const MrptDrive& drive, std::size_t n);

  /// One ray by simulateScanRay.
  [[nodiscard]] double cast_ray_m(double x_m, double y_m, double direction_rad, double range_max_m) const;

  /// A scan of `count` beams evenly around by laserScanSimulator, into an observation that is kept.
  void simulate_scan(double x_m, double y_m, double yaw_rad, std::size_t count, double range_max_m);
  [[nodiscard]] double simulated_m(std::size_t beam) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace benchmarks
