/// The door of testing/: the laws of each concept as functions that any policy's test calls, a user's too.
///
/// Each takes a value and returns a LawReport: assert holds() with any test framework and show text().
/// - testing/law_report.hpp: LawReport
/// - testing/entropy_laws.hpp: check_entropy_laws(measure)
/// - testing/cell_policy_laws.hpp: check_cell_policy_laws(policy)
/// - testing/estimator_laws.hpp: check_estimator_laws(estimator)
#pragma once

#include "incognita/testing/cell_policy_laws.hpp"
#include "incognita/testing/entropy_laws.hpp"
#include "incognita/testing/estimator_laws.hpp"
#include "incognita/testing/law_report.hpp"
