/// The door of entropy/: generalised entropies of occupancy cells.
///
/// - entropy/concept.hpp: the concept EntropyMeasure
/// - entropy/shannon.hpp, renyi.hpp, tsallis.hpp: Shannon{}, Renyi{alpha}, Tsallis{q}
/// - entropy/behavioral.hpp: Behavioral{alpha} of cells and of probability vectors (Seo et al., (17))
/// - entropy/log_odds_table.hpp: entropy_of_log_odds, exact, and EntropyTable for inner loops
/// - entropy/map_entropy.hpp: entropy_sum, map_entropy_nats, and entropy_change, the information gain
///   (Seo et al., (16))
/// - entropy/signed_relative_entropy.hpp: SiREn, coverage and certainty of a map of Dispersion in one number
/// - entropy/map_measures.hpp: other measures of a whole map, to compare with
/// - entropy/entropy_lines.hpp: what makes entropy_sum fast
///
/// # EntropyMeasure
/// The uncertainty of one binary cell, in nats.
/// - Type: any copy-constructible value: a struct, a class with a parameter, a lambda.
/// - Valid expression: measure(p) -> double, for a const measure and a double p in [0, 1].
/// - Laws: zero at p = 0 and 1, finite, non-negative, symmetric, greatest at 1/2, the same bits every time.
///   check_entropy_laws(measure) in testing/entropy_laws.hpp tests them.
/// - Complexity: O(1). Measures fill tables and write reports; inner loops ask an EntropyTable.
/// - Thread safety: const calls from several threads at once.
///
/// The measures here default to their Shannon member and equal Shannon to the bit there, are exact to 1e-12
/// relative wherever the result is a normal number, and give NaN for p outside [0, 1].
///
///     const auto gini = [](double p) { return 2.0 * p * (1.0 - p); };  // a measure of one's own
///     static_assert(incognita::EntropyMeasure<decltype(gini)>);
///     const incognita::EntropyTable table(gini);
///     double nats = table(0.4F);  // of a cell with log-odds 0.4
#pragma once

#include "incognita/entropy/behavioral.hpp"
#include "incognita/entropy/binary_cell.hpp"
#include "incognita/entropy/concept.hpp"
#include "incognita/entropy/entropy_lines.hpp"
#include "incognita/entropy/log_odds_table.hpp"
#include "incognita/entropy/map_entropy.hpp"
#include "incognita/entropy/map_measures.hpp"
#include "incognita/entropy/renyi.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/entropy/signed_relative_entropy.hpp"
#include "incognita/entropy/tsallis.hpp"
