/// grid/: the ground that beliefs, plans and worlds stand on. A `Lattice` says where cells lie; a `Grid`
/// holds values on a box of its cells and grows in any direction without moving the world; `traverse` walks
/// the cells of a segment. Over a grid: exact Euclidean distances, connected components, the region around a
/// seed. All are generic over two and three dimensions; a `FloorPlan` is a grid of what a building is made
/// of.
#pragma once

#include "incognita/grid/components.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/grid/floor_plan.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/grid/lattice.hpp"
#include "incognita/grid/traversal.hpp"
