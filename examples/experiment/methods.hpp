/// The methods of Seo et al., section VI-B, and references, as settings.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "experiment/settings.hpp"

namespace experiment {

/// A method as a composition of policies, and what it is in words.
struct Method {
  std::string_view name;
  std::string_view what;
  void (*compose)(Settings&);
};

namespace detail {

inline void estimate_by(Settings& settings, const char* filter, const char* cells, const char* decision_cells = "same") {
  settings.filter = filter;
  settings.cells = cells;
  settings.decision_cells = decision_cells;
}

inline void decide_by(Settings& settings, const char* information) {
  estimate_by(settings, "coupled", "t-bayes");
  settings.information = information;
  settings.navigation = "geodesic";
}

}  // namespace detail

/// A1 to A5 compare what estimates, B1 to B3 what decides, on the estimate of A5. B3 is A5.
[[nodiscard]] inline const auto& known_methods() {
  static constexpr std::array all{
      Method{"A1", "odometry alone, inverse model", [](Settings& s) { detail::estimate_by(s, "dead-reckoning", "log-odds"); }},
      Method{"A2", "decoupled localisation, inverse model", [](Settings& s) { detail::estimate_by(s, "decoupled", "log-odds"); }},
      Method{"A3", "coupled localisation, inverse model", [](Settings& s) { detail::estimate_by(s, "coupled", "log-odds"); }},
      Method{"A4", "decoupled localisation, T-BayesMap", [](Settings& s) { detail::estimate_by(s, "decoupled", "t-bayes"); }},
      Method{"A5", "coupled localisation, T-BayesMap", [](Settings& s) { detail::estimate_by(s, "coupled", "t-bayes"); }},
      Method{"B1", "A5, decides by a map of the inverse model", [](Settings& s) { detail::estimate_by(s, "coupled", "t-bayes", "log-odds"); }},
      Method{"B2", "A5, decides by a map of (6), the pose taken as exact",
             [](Settings& s) { detail::estimate_by(s, "coupled", "t-bayes", "t-bayes-exact-pose"); }},
      Method{"B3", "A5, decides by its own T-BayesMap", [](Settings& s) { detail::estimate_by(s, "coupled", "t-bayes"); }},
      Method{"nearest", "A5, goes to the frontier that costs least to reach", [](Settings& s) { detail::decide_by(s, "uniform"); }},
      Method{"size-per-cost", "A5, goes by the frontier's size per cost of the way (Isleyen et al.)", [](Settings& s) { detail::decide_by(s, "size"); }}};
  return all;
}

/// The method of a name; none when there is none.
[[nodiscard]] inline std::optional<Method> find_method(std::string_view name) {
  for (const Method& method : known_methods()) {
    if (method.name == name) return method;
  }
  return std::nullopt;
}

}  // namespace experiment
