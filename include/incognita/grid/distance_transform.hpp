/// The exact Euclidean distance transform of a grid, in two and three dimensions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "incognita/grid/grid.hpp"

namespace incognita {

namespace detail {

/// The parabola (x - at)^2 + height, as the point (at, at^2 + height): parabolas that show in the lower
/// envelope are the points on the lower convex hull.
struct EnvelopePoint {
  double at;
  double sum;
};

/// Replaces heights[x] by the smallest (x - q)^2 + heights[q] over all q. O(n); `hull` is scratch of the same
/// size. The comparisons are of integers below 2^53, so they are exact for lines of up to 10^5 cells.
inline void take_lower_envelope(std::vector<float>& heights, std::vector<EnvelopePoint>& hull) {
  constexpr float far = std::numeric_limits<float>::infinity();
  const std::size_t n = heights.size();
  std::size_t count = 0;
  for (std::size_t q = 0; q < n; ++q) {
    if (heights[q] == far) continue;
    const double at = static_cast<double>(q);
    const EnvelopePoint point{at, at * at + static_cast<double>(heights[q])};
    while (count >= 2) {
      const EnvelopePoint& a = hull[count - 2];
      const EnvelopePoint& b = hull[count - 1];
      if ((b.sum - a.sum) * (point.at - b.at) < (point.sum - b.sum) * (b.at - a.at)) break;
      --count;
    }
    hull[count++] = point;
  }
  if (count == 0) return;
  std::size_t k = 0;
  for (std::size_t q = 0; q < n; ++q) {
    const double x = static_cast<double>(q);
    while (k + 1 < count && hull[k + 1].sum - hull[k].sum <= 2.0 * x * (hull[k + 1].at - hull[k].at)) ++k;
    heights[q] = static_cast<float>(hull[k].sum + x * (x - 2.0 * hull[k].at));
  }
}

}  // namespace detail

/// The distance in metres from the centre of each cell of `grid` to the centre of the nearest cell for which
/// is_source(value) holds: 0 on a source, infinity when there is none. Cells outside of the grid's box are no
/// sources; the result has the grid's lattice and box, and infinity as its fill value. Exact up to the
/// rounding of a float. O(cells), whatever the distances. Felzenszwalb and Huttenlocher, Distance Transforms
/// of Sampled Functions (2012).
template <class Value, int Dim, class IsSource>
[[nodiscard]] Grid<float, Dim> distance_transform_m(const Grid<Value, Dim>& grid, IsSource&& is_source) {
  constexpr float far = std::numeric_limits<float>::infinity();
  Grid<float, Dim> result(grid.lattice(), grid.box(), far);
  if (grid.size() == 0) return result;

  // Along the last axis distances are counted, a whole layer (in the plane: a row) at a time.
  const Value* const values = grid.values().data();
  float* const distances = result.values().data();
  const Offset layer = grid.stride(Dim - 1);
  const Offset size = static_cast<Offset>(grid.size());
  for (Offset i = 0; i < layer; ++i) distances[i] = is_source(values[i]) ? 0.0F : far;
  for (Offset i = layer; i < size; ++i)
    distances[i] = is_source(values[i]) ? 0.0F : distances[i - layer] + 1.0F;
  for (Offset i = size - layer - 1; i >= 0; --i)
    distances[i] = std::min(distances[i], distances[i + layer] + 1.0F);
  for (Offset i = 0; i < size; ++i) distances[i] *= distances[i];

  // Along the others, the squares of the axes before are the heights of parabolas.
  std::vector<float> line;
  std::vector<detail::EnvelopePoint> hull;
  for (int axis = Dim - 2; axis >= 0; --axis) {
    const Offset stride = grid.stride(axis);
    const Offset count = grid.stride(axis + 1) / stride;
    line.resize(static_cast<std::size_t>(count));
    hull.resize(line.size());
    for (Offset block = 0; block < size; block += stride * count) {
      for (Offset first = block; first < block + stride; ++first) {
        for (Offset i = 0; i < count; ++i) line[static_cast<std::size_t>(i)] = distances[first + i * stride];
        detail::take_lower_envelope(line, hull);
        for (Offset i = 0; i < count; ++i) distances[first + i * stride] = line[static_cast<std::size_t>(i)];
      }
    }
  }
  const float resolution_m = static_cast<float>(grid.resolution_m());
  for (Offset i = 0; i < size; ++i) distances[i] = resolution_m * std::sqrt(distances[i]);
  return result;
}

}  // namespace incognita
