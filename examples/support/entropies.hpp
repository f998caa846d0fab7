/// What entropies are called on command lines and in studies.
#pragma once

#include <functional>
#include <string_view>

#include "incognita/entropy/behavioral.hpp"
#include "incognita/entropy/renyi.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/entropy/tsallis.hpp"

namespace examples {

/// An entropy whose kind is known only when the program runs.
using Measure = std::function<double(double)>;

/// shannon, which has no parameter, renyi, tsallis, or else behavioral.
[[nodiscard]] inline Measure make_measure(std::string_view entropy, double alpha) {
  if (entropy == "shannon") return incognita::Shannon{};
  if (entropy == "renyi") return incognita::Renyi{alpha};
  if (entropy == "tsallis") return incognita::Tsallis{alpha};
  return incognita::Behavioral{alpha};
}

}  // namespace examples
