/// Velocities of a robot in the plane.
#pragma once

namespace incognita {

/// What a unicycle (a robot that drives along its own x axis and turns) is told to do or does, in its own
/// frame.
struct Twist2 {
  double speed_m_per_s = 0.0;        ///< forwards > 0
  double turn_rate_rad_per_s = 0.0;  ///< counter-clockwise > 0

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(speed_m_per_s, turn_rate_rad_per_s);
  }
};

}  // namespace incognita
