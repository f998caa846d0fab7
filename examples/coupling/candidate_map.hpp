/// The picture of Fig. 7 of Seo et al.: candidate paths on the map they start from.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <string>

#include "coupling/candidates.hpp"
#include "coupling/panel.hpp"
#include "support/drawing.hpp"

namespace coupling {

inline void draw_candidates(const std::filesystem::path& path, const Ranking& ranking, double alpha) {
  constexpr examples::Color kBest{0.0, 0.5, 0.15};
  constexpr examples::Color kOther{0.8, 0.1, 0.1};
  const Area view_m{{3.0, -1.0}, {26.0, 21.0}};
  examples::Drawing drawing({view_m.lower, view_m.upper + Eigen::Vector2d(0.0, 0.8)}, 1500);
  const Panel panel{drawing, view_m};
  panel.map(ranking.map, probability_color);
  // The best last, on top.
  for (std::size_t rank = ranking.paths.size(); rank-- > 0;) {
    const RankedPath& candidate = ranking.paths[rank];
    const examples::Color& color = rank == 0 ? kBest : kOther;
    panel.line(candidate.path.points_m(), color, rank == 0 ? 5.0 : 2.5);
    for (const incognita::PoseBelief& belief : candidate.beliefs) panel.ellipse(belief, color, 1.5);
    drawing.marker(candidate.path.points_m().back(), color, 6.0);
  }
  for (std::size_t rank = 0; rank < ranking.paths.size(); ++rank) {
    const RankedPath& candidate = ranking.paths[rank];
    const std::string label = std::to_string(rank + 1) + ". " + candidate.name + ": " +
                              std::to_string(std::lround(candidate.gain_nats)) + " nats";
    drawing.text(candidate.path.points_m().back(), label, rank == 0 ? kBest : kOther, 18.0);
  }
  panel.robot(ranking.paths.front().path.points_m().front());
  std::ostringstream title;
  title << "Paths of " << ranking.paths.front().path.length_m()
        << " m ranked by Behavioral information gain (alpha " << alpha << ")";
  panel.title(title.str());
  drawing.legend({{"best path and 1 sigma of its predicted positions", kBest},
                  {"the others", kOther},
                  {"robot", kInk, examples::Swatch::dot},
                  {"occupied", probability_color(10.0F), examples::Swatch::area},
                  {"free", probability_color(-10.0F), examples::Swatch::area},
                  {"unknown", probability_color(0.0F), examples::Swatch::area}});
  drawing.write_png(path);
}

}  // namespace coupling
