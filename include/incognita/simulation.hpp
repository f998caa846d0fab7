/// The door of simulation/: a robot in a floor plan, for examples, tests and experiments.
///
/// - simulation/building.hpp: office buildings of any size from a seed, by building_params.hpp, corridor_net.hpp, room_rows.hpp and furniture.hpp;
///   building_layout.hpp says which rooms and doors they have
/// - simulation/plan_drawing.hpp: floor plans drawn in metres
/// - simulation/world.hpp: a floor plan with exact ranges and collisions
/// - simulation/start.hpp: start poses, drawn or checked
/// - simulation/unicycle.hpp: the arc that a twist drives
/// - simulation/robot.hpp: a disc that drives and collides
/// - simulation/odometry.hpp: noisy odometry
/// - simulation/range_sensor.hpp: a noisy range sensor
/// - simulation/simulator.hpp: all of it, step by step
///
///     incognita::Random random(1);
///     incognita::World world(plan);
///     const incognita::Pose2 T_world_start = incognita::random_start(world, 0.2, random);
///     incognita::Simulator simulator(std::move(world), T_world_start, {}, 1);
///     while (simulator.time_s() < 60.0) {
///       const incognita::Pose2 T_before_after = simulator.step({0.5, 0.1});
///       if (simulator.scan_is_new()) { /* use simulator.scan() */ }
///     }
#pragma once

#include "incognita/simulation/building.hpp"
#include "incognita/simulation/building_layout.hpp"
#include "incognita/simulation/building_params.hpp"
#include "incognita/simulation/corridor_net.hpp"
#include "incognita/simulation/furniture.hpp"
#include "incognita/simulation/odometry.hpp"
#include "incognita/simulation/plan_drawing.hpp"
#include "incognita/simulation/range_sensor.hpp"
#include "incognita/simulation/robot.hpp"
#include "incognita/simulation/room_rows.hpp"
#include "incognita/simulation/simulator.hpp"
#include "incognita/simulation/start.hpp"
#include "incognita/simulation/unicycle.hpp"
#include "incognita/simulation/world.hpp"
