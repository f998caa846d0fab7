/// The worlds of the experiments, drawn for this project in the spirit of Fig. 5 and Fig. 8 of Isleyen et al.
#pragma once

#include "support/drawn_plan.hpp"

namespace office_exploration {

using examples::Along;
using examples::draw_blocks;
using examples::draw_wall;
using examples::walled_floor;

/// 12 x 16 m: rooms on both sides of a corridor.
[[nodiscard]] inline incognita::FloorPlan small_office() {
  incognita::FloorPlan plan = walled_floor(12.0, 16.0);
  draw_wall(plan, Along::y, 4.9, 0.0, 16.0, {2.2, 8.0, 13.6});
  draw_wall(plan, Along::y, 7.1, 0.0, 16.0, {1.6, 6.0, 9.6, 14.0});
  draw_wall(plan, Along::x, 5.0, 0.0, 4.9, {});
  draw_wall(plan, Along::x, 10.8, 0.0, 4.9, {1.5});
  draw_wall(plan, Along::x, 3.8, 7.1, 12.0, {});
  draw_wall(plan, Along::x, 8.0, 7.1, 12.0, {10.6});
  draw_wall(plan, Along::x, 12.0, 7.1, 12.0, {});
  draw_blocks(plan, {{{1.3, 1.6}, {2.9, 2.4}},
                     {{1.8, 7.2}, {3.0, 8.8}},
                     {{0.1, 15.2}, {3.0, 15.9}},
                     {{2.4, 12.8}, {2.8, 13.2}},
                     {{10.8, 1.0}, {11.9, 2.6}},
                     {{9.0, 5.3}, {10.4, 6.3}},
                     {{8.4, 11.2}, {10.0, 11.95}},
                     {{9.2, 13.4}, {10.0, 14.8}}});
  return plan;
}

/// 28 x 19 m: rooms of many sizes and a hall along two corridors that meet.
[[nodiscard]] inline incognita::FloorPlan large_office() {
  incognita::FloorPlan plan = walled_floor(28.0, 19.0);
  draw_wall(plan, Along::x, 8.4, 0.0, 28.0, {2.6, 8.2, 13.4, 19.0, 25.5});
  draw_wall(plan, Along::x, 10.6, 0.0, 12.9, {3.0, 9.6});
  draw_wall(plan, Along::x, 10.6, 15.1, 28.0, {18.4, 24.5});
  draw_wall(plan, Along::y, 12.9, 10.6, 19.0, {13.0, 17.2});
  draw_wall(plan, Along::y, 15.1, 10.6, 19.0, {14.5});
  draw_wall(plan, Along::y, 6.2, 10.6, 19.0, {16.5});
  draw_wall(plan, Along::x, 15.0, 6.2, 12.9, {});
  draw_wall(plan, Along::y, 21.5, 10.6, 19.0, {16.8});
  draw_wall(plan, Along::x, 14.6, 21.5, 28.0, {});
  draw_wall(plan, Along::y, 5.4, 0.0, 8.4, {});
  draw_wall(plan, Along::y, 11.0, 0.0, 8.4, {3.0});
  draw_wall(plan, Along::y, 16.6, 0.0, 8.4, {});
  draw_blocks(plan, {{{1.6, 2.2}, {3.2, 3.0}},
                     {{1.6, 5.0}, {3.2, 5.8}},
                     {{7.4, 4.6}, {9.0, 6.2}},
                     {{12.9, 0.1}, {14.6, 0.9}},
                     {{13.4, 4.2}, {14.2, 5.8}},
                     {{18.4, 1.6}, {20.4, 2.8}},
                     {{18.4, 5.0}, {20.4, 6.2}},
                     {{22.6, 1.6}, {24.6, 2.8}},
                     {{22.6, 5.0}, {24.6, 6.2}},
                     {{26.9, 2.6}, {27.9, 5.0}},
                     {{2.0, 13.4}, {3.6, 15.4}},
                     {{8.4, 12.4}, {10.4, 13.2}},
                     {{6.2, 18.1}, {9.4, 18.9}},
                     {{17.4, 13.2}, {19.0, 14.0}},
                     {{17.4, 16.2}, {19.0, 17.0}},
                     {{24.0, 12.4}, {26.0, 13.0}},
                     {{24.6, 16.4}, {26.2, 17.2}}});
  return plan;
}

/// 6 x 6 m, full of boxes.
[[nodiscard]] inline incognita::FloorPlan cluttered_room() {
  incognita::FloorPlan plan = walled_floor(6.0, 6.0);
  draw_blocks(plan, {{{1.1, 1.1}, {1.7, 2.3}},
                     {{2.8, 0.1}, {3.2, 1.6}},
                     {{4.2, 1.5}, {5.0, 1.9}},
                     {{2.6, 2.8}, {4.0, 3.2}},
                     {{0.1, 3.4}, {1.2, 3.7}},
                     {{2.0, 4.3}, {2.6, 4.9}},
                     {{3.6, 4.3}, {3.9, 5.9}},
                     {{4.8, 3.7}, {5.2, 4.7}}});
  return plan;
}

}  // namespace office_exploration
