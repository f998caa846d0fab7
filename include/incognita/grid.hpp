/// grid/: the ground that beliefs, plans and worlds stand on. A `Lattice` says where cells lie; a `Grid`
/// holds values on a box of its cells and grows in any direction without moving the world; `traverse` walks
/// the cells of a segment. Over a grid: exact Euclidean distances, connected components, the region around a
/// seed. All are generic over two and three dimensions; a `FloorPlan` is a grid of what a building is made
/// of. In the plane `CellBits` holds a bit a cell, and `SegmentWalk` with `visit_set` walks a segment over the cells whose bit
/// is set.
#pragma once

#include "incognita/grid/cell_bits.hpp"
#include "incognita/grid/components.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/grid/floor_plan.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/grid/lattice.hpp"
#include "incognita/grid/near_distance.hpp"
#include "incognita/grid/segment_walk.hpp"
#include "incognita/grid/tile_neighbors.hpp"
#include "incognita/grid/traversal.hpp"
