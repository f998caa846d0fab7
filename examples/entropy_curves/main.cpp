/// Draws Figs. 1 and 8 of Seo et al.: Rényi and Behavioral entropy of a cell over its probability for several
/// alpha, and how steeply they change. Writes entropies.png and sensitivities.png, and their numbers as CSV.
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "incognita/entropy.hpp"
#include "support/chart.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"

namespace {

/// A curve's parameter and colour: cold below 1, warm above. 1 is Shannon, dashed black.
struct Curve {
  double alpha;
  const char* color;
};
constexpr std::array<Curve, 6> kCurves = {{{0.2, "#08306b"},
                                           {0.5, "#2b8cbe"},
                                           {1.0, "#000000"},
                                           {1.5, "#fdae61"},
                                           {3.0, "#e6550d"},
                                           {5.0, "#99000d"}}};
constexpr int kSteps = 1000;  // of p on [0, 1]

/// |dH/dp| in nats, by a central difference: the error is below 2e-5 on [0.001, 0.999].
template <incognita::EntropyMeasure Measure>
double sensitivity_nats(const Measure& measure, double p) {
  constexpr double kHalfStep = 1e-6;
  return std::abs(measure(p + kHalfStep) - measure(p - kHalfStep)) / (2.0 * kHalfStep);
}

/// `value(measure, p)` at first_step / kSteps ... last_step / kSteps, one series for each alpha.
template <class Measure, class Value>
std::vector<examples::Series> series_over_p(int first_step, int last_step, Value value) {
  std::vector<examples::Series> all;
  for (const Curve& curve : kCurves) {
    const Measure measure(curve.alpha);
    std::ostringstream name;
    name << "α = " << curve.alpha << (curve.alpha == 1.0 ? " (Shannon)" : "");
    examples::Series series{.name = name.str(), .color = curve.color, .width = 2.5};
    if (curve.alpha == 1.0) series.stroke = examples::Stroke::dashed;
    for (int step = first_step; step <= last_step; ++step) {
      const double p = static_cast<double>(step) / kSteps;
      series.x.push_back(p);
      series.y.push_back(value(measure, p));
    }
    all.push_back(std::move(series));
  }
  return all;
}

/// Rényi's columns, then Behavioral's; the charts have the same x.
void write_csv(const std::filesystem::path& path, const examples::Chart& renyi,
               const examples::Chart& behavioral) {
  std::ofstream file(path);
  file.precision(12);
  file << "p";
  for (const char* family : {"renyi", "behavioral"}) {
    for (const Curve& curve : kCurves) file << ',' << family << "_alpha_" << curve.alpha << "_nats";
  }
  file << '\n';
  for (std::size_t row = 0; row < renyi.series.front().x.size(); ++row) {
    file << renyi.series.front().x[row];
    for (const examples::Chart* chart : {&renyi, &behavioral}) {
      for (const examples::Series& series : chart->series) file << ',' << series.y[row];
    }
    file << '\n';
  }
  file.close();
  if (!file) throw examples::OutputError("cannot write " + path.filename().string());
}

void draw(const std::filesystem::path& folder) {
  const std::string p_label = "probability p that the cell is occupied";
  const auto entropy = [](const auto& measure, double p) { return measure(p); };
  const auto sensitivity = [](const auto& measure, double p) { return sensitivity_nats(measure, p); };
  const auto chart = [&](std::string title, std::string y_label, std::vector<examples::Series> series,
                         double y_max) {
    return examples::Chart{.title = std::move(title),
                           .x_label = p_label,
                           .y_label = std::move(y_label),
                           .series = std::move(series),
                           .x_range = {{0.0, 1.0}},
                           .y_range = {{0.0, y_max}}};
  };
  using incognita::Behavioral;
  using incognita::Renyi;
  const auto renyi =
      chart("(a) Rényi entropy", "entropy (nats)", series_over_p<Renyi>(0, kSteps, entropy), 0.72);
  const auto behavioral =
      chart("(b) Behavioral entropy", "entropy (nats)", series_over_p<Behavioral>(0, kSteps, entropy), 0.72);
  const auto renyi_slope = chart("(a) Rényi entropy", "sensitivity |dH/dp| (nats)",
                                 series_over_p<Renyi>(1, kSteps - 1, sensitivity), 8.0);
  const auto behavioral_slope = chart("(b) Behavioral entropy", "sensitivity |dH/dp| (nats)",
                                      series_over_p<Behavioral>(1, kSteps - 1, sensitivity), 8.0);

  examples::OutputFolder output(folder);
  write_csv(output.staged("entropies.csv"), renyi, behavioral);
  write_csv(output.staged("sensitivities.csv"), renyi_slope, behavioral_slope);
  examples::write_chart_png(output.staged("entropies.png"), {renyi, behavioral});
  examples::write_chart_png(output.staged("sensitivities.png"), {renyi_slope, behavioral_slope});
  for (const std::filesystem::path& file : output.publish()) std::cout << file.string() << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder = "output/entropy_curves";
  CLI::App app(
      "Draws Renyi and Behavioral entropy of a cell, and their sensitivity, over its probability for several "
      "alpha.");
  app.add_option("--output", folder, "folder for the charts (PNG) and their numbers (CSV)")
      ->type_name("DIR")
      ->capture_default_str();
  return examples::run_program("entropy_curves", app, [&] {
    app.parse(argc, argv);
    draw(folder);
  });
}
