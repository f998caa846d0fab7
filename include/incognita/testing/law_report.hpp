/// What a check of a concept's laws found. Every check_*_laws function under testing/ returns one, so that a
/// policy's own test, with any test framework, only asserts holds() and shows the text.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace incognita {

/// The laws that a value broke, one sentence each. A plain value.
struct LawReport {
  std::vector<std::string> violations;  ///< in the order in which they were found

  /// True when no law was broken.
  [[nodiscard]] bool holds() const { return violations.empty(); }

  /// Records `law` as broken unless `kept`. Say the law and the arguments that break it: "H(p) = H(1 - p) at
  /// p = 0.2".
  void check(bool kept, std::string law) {
    if (!kept) violations.push_back(std::move(law));
  }

  /// The violations, one per line; empty when the laws hold.
  [[nodiscard]] std::string text() const {
    std::string lines;
    for (const std::string& violation : violations) lines += violation + "\n";
    return lines;
  }
};

}  // namespace incognita
