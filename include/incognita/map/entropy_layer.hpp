/// The information in a map of the plane, followed scan by scan.
#pragma once

#include <utility>

#include "incognita/map/cell_sum.hpp"

namespace incognita {

/// How much less the entropy of a map is than if nothing were known: the sum of H(0) - H(log-odds) over its cells, see CellSum.
/// Entropy is called with log-odds (float), as an EntropyTable.
template <class Entropy>
class EntropyLayer {
 public:
  /// Of a map on this lattice that has no cells yet; `entropy` is a measure of log-odds in nats, such as an EntropyTable.
  EntropyLayer(const Lattice<2>& lattice, Entropy entropy) : sum_(lattice, Information(std::move(entropy))) {}

  /// As CellSum::follow.
  template <CellPolicy Cell>
  void follow(const Map<Cell, 2>& map) {
    sum_.follow(map);
  }

  /// As CellSum::rebuild.
  template <CellPolicy Cell>
  void rebuild(const Map<Cell, 2>& map) {
    sum_.rebuild(map);
  }

  /// In nats. Negative where log-odds have more entropy than none, which no entropy of this library has.
  [[nodiscard]] double information_nats() const { return sum_.value(); }

 private:
  struct Information {
    Entropy entropy;
    double unknown_nats;

    explicit Information(Entropy of) : entropy(std::move(of)), unknown_nats(entropy(0.0F)) {}

    template <CellPolicy Cell>
    [[nodiscard]] double operator()(const Cell& /*policy*/, const typename Cell::State& state) const {
      return unknown_nats - entropy(Cell::log_odds(state));
    }
  };

  CellSum<Information> sum_;
};

}  // namespace incognita
