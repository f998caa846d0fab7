/// Binary trees of OctoMap (.bt; Hornung et al. 2013), in which a voxel is free, occupied or unknown.
///
/// OctoMap's voxel with the key k covers [(k - 32768) r, (k - 32767) r) on each axis, r its resolution: the voxels'
/// faces are multiples of r, its keys have 16 bits, and the root of its tree, of depth 0, covers 65536 r a side
/// around the origin. So cell i of a lattice with its origin at 0, as maps have, is the key i + 32768.
///
/// A .bt file holds the tree alone: from the root down, two bytes a node with two bits a child (00 unknown, 01
/// free, 10 occupied, 11 has children; child 0 in the lowest bits, bit 0 of its number for x, 1 for y, 2 for z).
/// A leaf above depth 16 stands for all voxels in it. OctoMap writes what is most likely: occupied from a
/// probability of 0.5 on (OccupancyThresholds::octomap), free below, and reads it back at its clamping thresholds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/io/atomic_file.hpp"
#include "incognita/io/belief.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/read_file.hpp"
#include "incognita/map/occupancy.hpp"

namespace incognita {

/// What OctoMap's trees do unless told otherwise, as probabilities; natural log-odds beside them.
struct OctoMapDefaults {
  static constexpr double probability_hit = 0.7;             ///< 0.847
  static constexpr double probability_miss = 0.4;            ///< -0.405
  static constexpr double occupancy_threshold = 0.5;         ///< a probability; log-odds 0: a node is occupied from it on
  static constexpr double clamping_threshold_min = 0.1192;   ///< a probability; log-odds -2.000
  static constexpr double clamping_threshold_max = 0.971;    ///< a probability; log-odds 3.511
};

/// No .bt file is larger than this, and no grid that is made of one has more cells.
inline constexpr std::size_t octomap_file_size_max_bytes = std::size_t{1} << 28;
inline constexpr std::int64_t octomap_cells_max = std::int64_t{1} << 28;  ///< of such a grid

/// The part of a tree, in z, that becomes a plane: the voxels that reach into [lower_m, upper_m).
struct OctoMapHeights {
  double lower_m = -std::numeric_limits<double>::infinity();  ///< above the tree's origin
  double upper_m = std::numeric_limits<double>::infinity();   ///< likewise, > lower_m
};

namespace detail {

inline constexpr std::string_view octomap_first_line = "# Octomap OcTree binary file";
inline constexpr int octomap_depth = 16;
inline constexpr int octomap_key_zero = 1 << (octomap_depth - 1);

/// Where a voxel comes in a tree: the bits of its keys, z y x from the highest down, and whether it is occupied in
/// the lowest bit.
[[nodiscard]] inline std::uint64_t octomap_place(const Index<3>& key, bool is_occupied) {
  std::uint64_t place = 0;
  for (int bit = octomap_depth - 1; bit >= 0; --bit) {
    for (int axis = 2; axis >= 0; --axis) place = (place << 1U) | ((static_cast<unsigned>(key[axis]) >> bit) & 1U);
  }
  return (place << 1U) | static_cast<std::uint64_t>(is_occupied);
}

/// Writes the nodes of a tree, given its voxels by their sorted places.
class OctoMapWriter {
 public:
  explicit OctoMapWriter(std::span<const std::uint64_t> voxels) {
    if (voxels.empty()) return;
    node_count_ = 1;
    write_node(voxels, octomap_depth);
  }

  [[nodiscard]] const std::string& data() const { return data_; }
  [[nodiscard]] std::size_t node_count() const { return node_count_; }

 private:
  enum Kind : unsigned { unknown = 0, free = 1, occupied = 2, inner = 3 };

  /// Of the voxels in a cube of 2^level a side.
  [[nodiscard]] static Kind kind_of(std::span<const std::uint64_t> voxels, int level) {
    if (voxels.empty()) return unknown;
    const std::uint64_t is_occupied = voxels.front() & 1U;
    const bool is_leaf = voxels.size() == std::uint64_t{1} << (3 * level) &&
                         std::all_of(voxels.begin(), voxels.end(),
                                     [is_occupied](std::uint64_t voxel) { return (voxel & 1U) == is_occupied; });
    if (!is_leaf) return inner;
    return is_occupied == 1 ? occupied : free;
  }

  void write_node(std::span<const std::uint64_t> voxels, int level) {
    std::span<const std::uint64_t> children[8];
    unsigned kinds = 0;
    for (unsigned child = 0; child < 8; ++child) {
      const auto end = std::partition_point(voxels.begin(), voxels.end(), [&](std::uint64_t voxel) {
        return ((voxel >> (3 * (level - 1) + 1)) & 7U) <= child;
      });
      const auto count = static_cast<std::size_t>(end - voxels.begin());
      const Kind kind = kind_of(voxels.first(count), level - 1);
      if (kind == inner) children[child] = voxels.first(count);
      if (kind != unknown) ++node_count_;
      kinds |= kind << (2 * child);
      voxels = voxels.subspan(count);
    }
    data_ += static_cast<char>(kinds & 0xFFU);
    data_ += static_cast<char>(kinds >> 8U);
    for (const auto& child : children) {
      if (!child.empty()) write_node(child, level - 1);
    }
  }

  std::string data_;
  std::size_t node_count_ = 0;
};

/// How far, in voxels, a lattice's cells are from OctoMap's on an axis. Throws std::invalid_argument unless it is a
/// whole number.
[[nodiscard]] inline double octomap_shift(double origin_m, double resolution_m) {
  const double cells = origin_m / resolution_m;
  require(std::abs(cells - std::round(cells)) <= 1e-6, "write_octomap", "the lattice's origin, in cells,", cells,
          "a whole number: the faces of OctoMap's voxels are multiples of the resolution");
  return std::round(cells);
}

/// The key of a cell on an axis. Throws std::invalid_argument for one that 16 bits cannot hold.
[[nodiscard]] inline int octomap_key(double cell) {
  require(cell >= -octomap_key_zero && cell < octomap_key_zero, "write_octomap", "a cell's distance from the origin, in cells,",
          cell, "in -32768..32767, as OctoMap's keys have 16 bits");
  return static_cast<int>(cell) + octomap_key_zero;
}

/// The header of a .bt file and what comes after it.
struct OctoMapFile {
  double resolution_m = 0.0;
  std::uint64_t node_count = 0;
  std::string_view nodes;
};

[[nodiscard]] inline OctoMapFile parse_octomap_header(std::string_view content, const std::filesystem::path& file) {
  const auto fail = [&file](const std::string& what) { throw InputError(file, "not a valid .bt file: " + what); };
  if (!content.starts_with(octomap_first_line)) {
    fail("it must start with \"" + std::string(octomap_first_line) + '"');
  }
  OctoMapFile header;
  std::optional<double> resolution_m;
  std::optional<double> node_count;
  bool is_octree = false;
  while (true) {
    const std::size_t length = content.find('\n');
    if (length == std::string_view::npos) fail("it ends before the line \"data\"");
    std::string_view line = content.substr(0, length);
    content.remove_prefix(length + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line == "data") break;
    if (line.empty() || line[0] == '#') continue;
    const std::string_view key = line.substr(0, line.find(' '));
    const std::string_view value = line.substr(std::min(key.size() + 1, line.size()));
    if (key == "id") {
      if (value != "OcTree") fail("its id is " + shown(value) + ", but must be OcTree");
      is_octree = true;
    } else if (key == "size") {
      node_count = parse_number(value);
      if (!node_count || !(*node_count >= 0.0 && *node_count <= 1e15) || *node_count != std::floor(*node_count)) {
        fail("its size is " + shown(value) + ", but must be a whole number of nodes");
      }
    } else if (key == "res") {
      resolution_m = parse_number(value);
      if (!resolution_m || !(*resolution_m >= 1e-6 && *resolution_m <= 1e6)) {
        fail("its res is " + shown(value) + ", but must be 1e-06 to 1e+06 m");
      }
    } else {
      fail("its header has the line " + shown(line));
    }
  }
  if (!is_octree || !node_count || !resolution_m) fail("its header lacks one of id, size and res");
  header.resolution_m = *resolution_m;
  header.node_count = static_cast<std::uint64_t>(*node_count);
  header.nodes = content;
  return header;
}

/// Walks through the nodes of a tree, calling visit(first cell, cells a side, is occupied) for each leaf.
template <class Visit>
class OctoMapWalk {
 public:
  OctoMapWalk(const OctoMapFile& tree, const std::filesystem::path& file, Visit visit)
      : unread_(tree.nodes), file_(file), visit_(visit) {
    if (tree.node_count > 0) {
      node_count_ = 1;
      read_node(Index<3>(-octomap_key_zero, -octomap_key_zero, -octomap_key_zero), octomap_depth);
    }
    if (node_count_ != tree.node_count) {
      fail("it has " + std::to_string(node_count_) + " nodes, but its size is " + std::to_string(tree.node_count));
    }
    if (!unread_.empty()) fail("it goes on after its tree by " + std::to_string(unread_.size()) + " bytes");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_, "not a valid .bt file: " + what);
  }

  void read_node(const Index<3>& first, int level) {
    if (level == 0) fail("it is deeper than 16 levels");
    if (unread_.size() < 2) fail("it ends within its tree");
    const unsigned kinds = static_cast<unsigned char>(unread_[0]) + 256U * static_cast<unsigned char>(unread_[1]);
    unread_.remove_prefix(2);
    const int side = 1 << (level - 1);
    const auto first_of = [&](int child) {
      return Index<3>(first[0] + (child & 1) * side, first[1] + (child >> 1 & 1) * side, first[2] + (child >> 2) * side);
    };
    for (int child = 0; child < 8; ++child) {
      const unsigned kind = kinds >> (2 * child) & 3U;
      if (kind != 0) ++node_count_;
      if (kind == 1 || kind == 2) visit_(first_of(child), side, kind == 2);
    }
    for (int child = 0; child < 8; ++child) {
      if ((kinds >> (2 * child) & 3U) == 3U) read_node(first_of(child), level - 1);
    }
  }

  std::string_view unread_;
  const std::filesystem::path& file_;
  Visit visit_;
  std::uint64_t node_count_ = 0;
};

/// The leaves that `counts` lets through as a grid of their first Dim axes; where several lie on one cell, occupied
/// wins.
template <int Dim, class Counts>
[[nodiscard]] OccupancyGrid<Dim> octomap_grid(const OctoMapFile& tree, const std::filesystem::path& file,
                                              Counts&& counts) {
  const auto box_of = [](const Index<3>& first, int side) {
    IndexBox<Dim> box;
    for (int axis = 0; axis < Dim; ++axis) {
      box.lower[axis] = first[axis];
      box.upper[axis] = first[axis] + side;
    }
    return box;
  };
  IndexBox<Dim> all;
  OctoMapWalk(tree, file, [&](const Index<3>& first, int side, bool) {
    if (counts(first, side)) all = enclosing_box(all, box_of(first, side));
  });
  std::int64_t cell_count = all.empty() ? 0 : 1;
  for (int axis = 0; axis < Dim && cell_count <= octomap_cells_max; ++axis) cell_count *= all.extent()[axis];
  if (cell_count > octomap_cells_max) {
    throw InputError(file, "what is known in it spans more than " + std::to_string(octomap_cells_max) + " cells");
  }
  OccupancyGrid<Dim> grid(Lattice<Dim>(tree.resolution_m), all, Occupancy::unknown);
  OctoMapWalk(tree, file, [&](const Index<3>& first, int side, bool is_occupied) {
    if (!counts(first, side)) return;
    const Grid<char, Dim> part(grid.lattice(), box_of(first, side));
    for (Offset offset = 0; offset < static_cast<Offset>(part.size()); ++offset) {
      Occupancy& cell = grid[grid.offset_of(part.index_at(offset))];
      if (cell != Occupancy::occupied) cell = is_occupied ? Occupancy::occupied : Occupancy::free;
    }
  });
  return grid;
}

}  // namespace detail

/// The bytes of a .bt file with the cells of a grid that are free or occupied. A plane becomes the layer of voxels
/// that holds the height `z_m`; for a grid in space it does not matter. Cubes of equal voxels become one leaf, as
/// OctoMap prunes them. Throws std::invalid_argument for a lattice whose origin is no multiple of its resolution,
/// and for cells beyond -32768..32767. O(n log n) for n cells.
template <int Dim>
[[nodiscard]] std::string encode_octomap(const OccupancyGrid<Dim>& occupancy, double z_m = 0.0) {
  static_assert(Dim == 2 || Dim == 3);
  const Lattice<Dim>& lattice = occupancy.lattice();
  double shift[3] = {0.0, 0.0, std::floor(z_m / lattice.resolution_m() + 1e-6)};
  for (int axis = 0; axis < Dim; ++axis) {
    shift[axis] = detail::octomap_shift(lattice.origin_m()[axis], lattice.resolution_m());
  }
  std::vector<std::uint64_t> voxels;
  for (Offset offset = 0; offset < static_cast<Offset>(occupancy.size()); ++offset) {
    if (occupancy[offset] == Occupancy::unknown) continue;
    const Index<Dim> index = occupancy.index_at(offset);
    Index<3> key;
    for (int axis = 0; axis < 3; ++axis) {
      key[axis] = detail::octomap_key(shift[axis] + (axis < Dim ? index[std::min(axis, Dim - 1)] : 0));
    }
    voxels.push_back(detail::octomap_place(key, occupancy[offset] == Occupancy::occupied));
  }
  std::sort(voxels.begin(), voxels.end());
  const detail::OctoMapWriter tree(voxels);
  return std::string(detail::octomap_first_line) +
         "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\nid OcTree\nsize " +
         std::to_string(tree.node_count()) + "\nres " + format_number(lattice.resolution_m()) + "\ndata\n" + tree.data();
}

/// The plane that a whole .bt file shows between two heights: a cell is occupied where a voxel above it is, else
/// free where one is, else unknown. Its lattice has its origin at 0, its box holds all that is known. `file` is
/// only named in errors. Throws InputError when it is malformed, cut off, or spans too many cells.
[[nodiscard]] inline OccupancyGrid<2> decode_octomap(std::string_view content, const std::filesystem::path& file,
                                                     const OctoMapHeights& heights = {}) {
  const detail::OctoMapFile tree = detail::parse_octomap_header(content, file);
  const double lower = heights.lower_m / tree.resolution_m + 1e-6;
  const double upper = heights.upper_m / tree.resolution_m - 1e-6;
  return detail::octomap_grid<2>(tree, file, [lower, upper](const Index<3>& first, int side) {
    return first[2] + side > lower && first[2] < upper;
  });
}

/// All voxels of a whole .bt file; see decode_octomap.
[[nodiscard]] inline OccupancyGrid<3> decode_octomap_space(std::string_view content,
                                                           const std::filesystem::path& file) {
  return detail::octomap_grid<3>(detail::parse_octomap_header(content, file), file,
                                 [](const Index<3>&, int) { return true; });
}

/// Reads a .bt file of at most 256 MiB; see decode_octomap.
[[nodiscard]] inline OccupancyGrid<2> read_octomap(const std::filesystem::path& file,
                                                   const OctoMapHeights& heights = {}) {
  return decode_octomap(read_file(file, octomap_file_size_max_bytes), file, heights);
}

/// Reads a .bt file of at most 256 MiB; see decode_octomap_space.
[[nodiscard]] inline OccupancyGrid<3> read_octomap_space(const std::filesystem::path& file) {
  return decode_octomap_space(read_file(file, octomap_file_size_max_bytes), file);
}

/// Writes a .bt file, which replaces one that is there only when complete; see encode_octomap. Throws InputError
/// when it cannot be written.
template <int Dim>
void write_octomap(const std::filesystem::path& file, const OccupancyGrid<Dim>& occupancy, double z_m = 0.0) {
  write_file_atomically(file, encode_octomap(occupancy, z_m));
}

/// Writes a belief as a .bt file, by OctoMap's threshold unless told otherwise; see encode_octomap.
template <class Cell, int Dim>
void write_belief_octomap(const std::filesystem::path& file, const Map<Cell, Dim>& map, double z_m = 0.0,
                          const OccupancyThresholds& thresholds = OccupancyThresholds::octomap()) {
  write_octomap(file, belief_occupancy(map, thresholds), z_m);
}

/// The probabilities that OctoMap itself gives what it has read from a .bt file: its clamping thresholds;
/// unknown_probability where it is unknown. What map_with_prior takes.
[[nodiscard]] inline ProbabilityGrid octomap_probabilities(const OccupancyGrid<2>& occupancy) {
  ProbabilityGrid probabilities(occupancy.lattice(), occupancy.box(), unknown_probability);
  for (Offset offset = 0; offset < static_cast<Offset>(occupancy.size()); ++offset) {
    if (occupancy[offset] == Occupancy::unknown) continue;
    probabilities[offset] = static_cast<float>(occupancy[offset] == Occupancy::occupied
                                                   ? OctoMapDefaults::clamping_threshold_max
                                                   : OctoMapDefaults::clamping_threshold_min);
  }
  return probabilities;
}

}  // namespace incognita
