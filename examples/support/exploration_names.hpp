/// What strategies, measures of information and costs of navigation are called on command lines and in files.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/exploration/frontier_view.hpp"
#include "incognita/exploration/strategy.hpp"

namespace examples {

template <class Enumerator>
struct Names;  // of the enumerators, in pairs

template <>
struct Names<incognita::Strategy> {
  static constexpr std::array<std::pair<incognita::Strategy, std::string_view>, 3> pairs{
      {{incognita::Strategy::persistent, "persistent"},
       {incognita::Strategy::last_mile, "last-mile"},
       {incognita::Strategy::online, "online"}}};
};

template <>
struct Names<incognita::FrontierInformation> {
  static constexpr std::array<std::pair<incognita::FrontierInformation, std::string_view>, 5> pairs{
      {{incognita::FrontierInformation::uniform, "uniform"},
       {incognita::FrontierInformation::size, "size"},
       {incognita::FrontierInformation::entropy, "entropy"},
       {incognita::FrontierInformation::big, "big"},
       {incognita::FrontierInformation::log_big, "log-big"}}};
};

template <>
struct Names<incognita::NavigationCost> {
  static constexpr std::array<std::pair<incognita::NavigationCost, std::string_view>, 3> pairs{
      {{incognita::NavigationCost::uniform, "uniform"},
       {incognita::NavigationCost::euclidean, "euclidean"},
       {incognita::NavigationCost::geodesic, "geodesic"}}};
};

/// All of them, in the order of the enumerators.
template <class Enumerator>
[[nodiscard]] std::vector<std::string> names_of() {
  std::vector<std::string> names;
  for (const auto& [value, name] : Names<Enumerator>::pairs) names.emplace_back(name);
  return names;
}

template <class Enumerator>
[[nodiscard]] std::string name_of(Enumerator value) {
  for (const auto& [named, name] : Names<Enumerator>::pairs) {
    if (named == value) return std::string(name);
  }
  throw std::invalid_argument("name_of: no enumerator");
}

/// Throws std::invalid_argument for a name of none.
template <class Enumerator>
[[nodiscard]] Enumerator named(std::string_view wanted) {
  for (const auto& [value, name] : Names<Enumerator>::pairs) {
    if (name == wanted) return value;
  }
  throw std::invalid_argument("named: nothing is called \"" + std::string(wanted) + "\"");
}

}  // namespace examples
