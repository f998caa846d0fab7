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
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const std::size_t n = heights.size();
  std::size_t count = 0;
  EnvelopePoint a{};  // hull[count - 2] and
  EnvelopePoint b{};  // hull[count - 1], kept at hand
  for (std::size_t i = 0; i < n; ++i) {
    if (heights[i] == infinite) continue;
    const double at = static_cast<double>(static_cast<int>(i));
    const EnvelopePoint point{at, at * at + static_cast<double>(heights[i])};
    while (count >= 2 && (b.sum - a.sum) * (point.at - b.at) >= (point.sum - b.sum) * (b.at - a.at)) {
      --count;
      b = a;
      if (count >= 2) a = hull[count - 2];
    }
    a = b;
    b = point;
    hull[count++] = point;
  }
  if (count == 0) return;
  // The envelope follows hull[k] up to its crossing with hull[k + 1].
  std::size_t q = 0;
  for (std::size_t k = 0; k < count; ++k) {
    std::size_t end = n;
    if (k + 1 < count) {
      const double crossing = (hull[k + 1].sum - hull[k].sum) / (2.0 * (hull[k + 1].at - hull[k].at));
      if (crossing < static_cast<double>(q)) continue;
      end = std::min(n, static_cast<std::size_t>(crossing) + 1);
    }
    const float at = static_cast<float>(hull[k].at);
    const float height = static_cast<float>(hull[k].sum - hull[k].at * hull[k].at);
    for (; q < end; ++q) {
      const float dx = static_cast<float>(static_cast<int>(q)) - at;
      heights[q] = height + dx * dx;
    }
  }
}

}  // namespace detail

/// Writes the distance in metres from the centre of each cell of `grid` to the centre of the nearest cell for which
/// is_source(value) holds into `result`, which takes the grid's box: 0 on a source, infinity when there is none. Cells outside of
/// the grid's box are no sources. `result` has the grid's lattice and infinity as its fill value; its storage is used again. Exact
/// up to the rounding of a float. O(cells), whatever the distances. Felzenszwalb and Huttenlocher, Distance Transforms of
/// Sampled Functions (2012).
template <class Value, int Dim, class IsSource>
void distance_transform_m(const Grid<Value, Dim>& grid, IsSource&& is_source, Grid<float, Dim>& result) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  result.clear_to(grid.box());
  if (grid.size() == 0) return;

  // Along the last axis distances are counted, a whole layer (in the plane: a row) at a time.
  const Value* const values = grid.values().data();
  float* const distances = result.values().data();
  const Offset layer = grid.stride(Dim - 1);
  const Offset size = static_cast<Offset>(grid.size());
  for (Offset i = 0; i < layer; ++i) distances[i] = is_source(values[i]) ? 0.0F : infinite;
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
}

/// The same in a grid of its own.
template <class Value, int Dim, class IsSource>
[[nodiscard]] Grid<float, Dim> distance_transform_m(const Grid<Value, Dim>& grid, IsSource&& is_source) {
  Grid<float, Dim> result(grid.lattice(), {}, std::numeric_limits<float>::infinity());
  distance_transform_m(grid, is_source, result);
  return result;
}

}  // namespace incognita
