/// The floor plans that studies name.
#pragma once

#include "experiment/study.hpp"
#include "incognita/core/random.hpp"
#include "incognita/io/floor_plan.hpp"
#include "incognita/io/kth_xml.hpp"
#include "incognita/simulation/building.hpp"
#include "kth_explorer/embedded_floor_plan.hpp"
#include "support/study_plans.hpp"

namespace experiment {

/// Throws incognita::InputError for a file that is no floor plan.
[[nodiscard]] inline incognita::FloorPlan load_plan(const StudyMap& map) {
  if (!map.file.empty()) return incognita::read_floor_plan(map.file);
  if (map.plan == "embedded") return incognita::read_kth_xml_text(examples::embedded_floor_plan_xml, "embedded floor plan");
  if (map.plan != "generated") return examples::study_plan(map.plan);
  incognita::BuildingParams params;
  params.size_m = {map.width_m, map.height_m};
  params.resolution_m = 0.1;
  incognita::Random random(map.plan_seed);
  return incognita::make_building(params, random);
}

}  // namespace experiment
