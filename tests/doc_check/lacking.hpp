/// What doc_check.py must find, and what it must not. Each line ends with what it lacks.
#pragma once

#include <stdexcept>
#include <vector>

#include <Eigen/Core>

namespace incognita {

struct Nameless {};  // lacks [no comment]

/// Which.
enum class Kind {  // lacks [no comment of the value untold]
  told,  ///< said
  untold  // not
};

/// A kind with nothing untold.
enum class Whole {
  one  ///< said
};

/// Numbers.
struct Numbers {
  double length_m = 0.0;  ///< fine by its name
  double log_odds_max = 0.0;  ///< fine by its name
  double alpha = 0.0;  ///< fine by its name
  /// How long it is.
  float length = 0.0F;  // lacks [no unit]
  double height = 0.0;  ///< in metres
  int number = 0;  ///< needs none
  double silent_m = 0.0;  // lacks [no comment]
};

/// Twice a robot's length.
inline double twice(double length) {  // lacks [no unit of length] [no unit of what it returns]
  return 2.0 * length;
}

/// Twice the length.
inline double twice_m(double length_m) { return 2.0 * length_m; }

/// Refuses what is negative.
inline void refuse(int value) {  // lacks [throws, but does not say so]
  if (value < 0) throw std::invalid_argument("refuse");
}

/// Throws std::invalid_argument for what is negative.
inline void refuse_openly(int value) {
  if (value < 0) throw std::invalid_argument("refuse_openly");
}

/// Goes through them.
inline void go(const std::vector<Eigen::Vector2d>& points_m) {  // lacks [no shape or frame of what it takes]
  (void)points_m;
}

/// Goes through them, in the map's frame.
inline void go_in_map(const std::vector<Eigen::Vector2d>& points_m) { (void)points_m; }

/// Holds something.
class Holder {
 public:
  Holder() = default;  // lacks [no comment]

  /// Asks for help.
  int get() const { return help(1); }  // lacks [throws, but does not say so]

 private:
  struct Hidden {
    double length = 0.0;
  };

  int help(int value) const {
    if (value < 0) throw std::invalid_argument("help");
    return value;
  }
};

namespace detail {

inline double undocumented(double length) { return length; }

}  // namespace detail

}  // namespace incognita
