/// Line charts as PNG, drawn by gnuplot: a value that describes a chart, and a function that draws several
/// in rows.
#pragma once

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace examples {

/// How a series is drawn.
enum class Stroke { solid, dashed, dotted, dash_dotted, points };

/// One curve. x and y have the same length; where y is NaN the curve has a gap. Where low and high are not empty, they have that length
/// too, and a transparent band reaches from one to the other.
struct Series {
  std::string name = {};  ///< in the legend; none when empty
  std::vector<double> x = {};
  std::vector<double> y = {};
  std::string color = "#000000";
  Stroke stroke = Stroke::solid;
  double width = 2.0;
  std::vector<double> low = {};
  std::vector<double> high = {};
};

/// One panel. Labels carry the unit: "range (m)".
struct Chart {
  std::string title = {};
  std::string x_label = {};
  std::string y_label = {};
  std::vector<Series> series = {};
  std::optional<std::pair<double, double>> x_range = {};  ///< of the data when not set
  std::optional<std::pair<double, double>> y_range = {};
  /// gnuplot's words for the place, such as "top right"; "off" for none. By default rows of three under the
  /// panel.
  std::string legend = "below center horizontal maxcols 3";
  bool equal_axes = false;  ///< one unit is as long on y as on x
  bool y_logarithmic = false;  ///< y is above 0 then
  double lines_below = 6.5;    ///< room for the tics, the label of x and a legend below, in lines of text
  std::vector<std::string> names = {};  ///< of the places 1, 2, ... on x, instead of numbers; slanted where they are long
  bool only_legend = false;             ///< nothing but the names of the series
};

/// The lines_below that a legend of so many rows needs.
[[nodiscard]] inline double lines_below_legend(std::size_t rows) { return 4.3 + 1.2 * static_cast<double>(rows); }

/// How panels are put together.
struct ChartLayout {
  std::size_t columns = 0;  ///< 0: one row
  int panel_width_px = 800;
  int panel_height_px = 640;
};

/// True when gnuplot is there to draw.
[[nodiscard]] inline bool gnuplot_available() {
  return std::system("command -v gnuplot >/dev/null 2>&1") == 0;
}

/// Throws std::runtime_error when it is not.
inline void require_gnuplot() {
  if (!gnuplot_available()) {
    throw std::runtime_error("gnuplot is missing; install it to draw charts (Debian: gnuplot-nox)");
  }
}

namespace detail {

/// A gnuplot string constant.
inline std::string quoted(const std::string& text) {
  std::string constant = "'";
  for (const char c : text) constant += c == '\'' ? "''" : std::string(1, c == '\n' ? ' ' : c);
  return constant + "'";
}

inline std::string range(const std::optional<std::pair<double, double>>& limits) {
  if (!limits) return "[*:*]";
  std::ostringstream text;
  text << "[" << limits->first << ":" << limits->second << "]";
  return text.str();
}

inline std::string style(const Series& series) {
  std::ostringstream text;
  if (series.stroke == Stroke::points) {
    text << "with points pt 7 ps " << 0.4 * series.width;
  } else {
    constexpr const char* dashes[] = {" dt 1", " dt (8,5)", " dt (2,4)", " dt (12,4,2,4)"};  // in the order of Stroke
    text << "with lines lw " << series.width << dashes[static_cast<std::size_t>(series.stroke)];
  }
  text << " lc rgb " << quoted(series.color);
  return text.str();
}

/// What is wrong with a series; empty when nothing is.
inline std::string fault_of(const Series& series) {
  const std::size_t size = series.x.size();
  const std::string of_x = ", but must have " + std::to_string(size) + " as x has";
  const auto values = [](const char* name, std::size_t count) { return std::string(name) + " has " + std::to_string(count) + " values"; };
  if (series.y.size() != size) return values("y", series.y.size()) + of_x;
  if (series.low.size() != series.high.size()) return values("high", series.high.size()) + ", but low " + std::to_string(series.low.size());
  if (!series.low.empty() && series.low.size() != size) return values("low", series.low.size()) + of_x;
  return "";
}

/// The places 1, 2, ... on x, under their names.
inline std::string names_script(const std::vector<std::string>& names, int panel_width_px) {
  std::size_t longest = 0;
  for (const std::string& name : names) longest = std::max(longest, name.size());
  constexpr int margins_px = 120;
  constexpr int letter_px = 10;
  const auto fitting = static_cast<std::size_t>(std::max(0, panel_width_px - margins_px) / letter_px);
  std::string text = "set xtics ";
  if ((longest + 1) * names.size() > fitting) text += "rotate by 20 right ";
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "(" : ", ") + quoted(names[i]) + ' ' + std::to_string(i + 1);
  return text + ")\n";
}

/// Whether there is anything to draw.
inline bool has_points(const Chart& chart) {
  return std::any_of(chart.series.begin(), chart.series.end(), [](const Series& series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) return true;
    }
    return false;
  });
}

/// The commands for one panel, whose first series is $series<block>.
inline std::string panel_script(const Chart& chart, std::size_t block, int panel_width_px) {
  std::ostringstream out;
  const bool is_below = chart.legend.starts_with("below");
  out << "set title " << quoted(chart.title) << "\nset xlabel " << quoted(chart.x_label) << "\nset ylabel " << quoted(chart.y_label)
      << "\nset size " << (chart.equal_axes ? "ratio -1" : "noratio") << "\nset bmargin";
  if (is_below) out << ' ' << chart.lines_below;
  out << "\nset border 3 lw 1.2\nset tics nomirror out\nset xtics nomirror out autofreq norotate\nset ytics nomirror out autofreq\n"
      << "set grid lw 0.8 lc rgb '#dddddd' lt 1\nunset label\n";
  if (!chart.names.empty()) out << names_script(chart.names, panel_width_px);
  if (chart.only_legend) {
    out << "unset border\nunset tics\nunset grid\n";
  } else if (!has_points(chart)) {
    out << "unset tics\nunset grid\nset label 'nothing to draw' at graph 0.5,0.5 center\n";
  }
  const bool is_blank = chart.only_legend || !has_points(chart);
  out << (chart.y_logarithmic && !is_blank ? "set" : "unset") << " logscale y\n";
  out << "set xrange " << (is_blank ? "[0:1]" : range(chart.x_range)) << "\nset yrange " << (is_blank ? "[0:1]" : range(chart.y_range)) << '\n'
      << (chart.legend == "off" ? "unset key" : "set key " + std::string(is_below ? "" : "inside ") + chart.legend +
                                                    " reverse Left samplen 2.5 spacing 1.1")
      << '\n';
  const char* separator = "plot ";
  for (std::size_t i = 0; i < chart.series.size() && !is_blank; ++i) {
    if (chart.series[i].low.empty()) continue;
    out << separator << "$series" << block + i << " using 1:3:4 with filledcurves fs transparent solid 0.2 noborder fc rgb "
        << quoted(chart.series[i].color) << " notitle";
    separator = ", ";
  }
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const Series& series = chart.series[i];
    if (is_blank && series.name.empty()) continue;
    out << separator << (is_blank ? "NaN" : "$series" + std::to_string(block + i) + " using 1:2") << ' ' << style(series)
        << (series.name.empty() ? " notitle" : " title " + quoted(series.name));
    separator = ", ";
  }
  if (std::string_view(separator) == "plot ") out << "plot NaN notitle";
  out << '\n';
  return out.str();
}

/// gnuplot's commands for all panels.
inline std::string script(const std::filesystem::path& path, const std::vector<Chart>& panels, const ChartLayout& layout) {
  std::ostringstream out;
  out.precision(10);
  std::size_t block = 0;
  for (const Chart& chart : panels) {
    for (const Series& series : chart.series) {
      if (const std::string fault = fault_of(series); !fault.empty()) {
        throw std::invalid_argument("chart: the series '" + series.name + "' is malformed: " + fault);
      }
      out << "$series" << block++ << " << END\n";
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        out << series.x[i] << ' ' << series.y[i];
        if (!series.low.empty()) out << ' ' << series.low[i] << ' ' << series.high[i];
        out << '\n';
      }
      out << "END\n";
    }
  }
  const std::size_t columns = layout.columns == 0 ? panels.size() : std::min(layout.columns, panels.size());
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  out << "set encoding utf8\n"
      << "set terminal pngcairo noenhanced size " << static_cast<std::size_t>(layout.panel_width_px) * columns << ','
      << static_cast<std::size_t>(layout.panel_height_px) * rows << " font 'DejaVu Sans,14'\n"
      << "set output " << quoted(path.string()) << "\n"
      << "set multiplot layout " << rows << ',' << columns << "\n"
      << "set format '%g'\nset title offset 0,-0.4\n";
  block = 0;
  for (const Chart& chart : panels) {
    out << panel_script(chart, block, layout.panel_width_px);
    block += chart.series.size();
  }
  out << "unset multiplot\nunset output\n";
  return out.str();
}

}  // namespace detail

/// Draws the panels, by default side by side, into the PNG file `path`, which is replaced only when complete. Throws
/// std::invalid_argument when a series is malformed and std::runtime_error, in one line, when gnuplot is
/// missing or fails. Not thread safe: it ignores SIGPIPE while gnuplot runs.
inline void write_chart_png(const std::filesystem::path& path, const std::vector<Chart>& panels, const ChartLayout& layout = {}) {
  require_gnuplot();
  const std::filesystem::path part = path.string() + ".part";
  const std::string commands = detail::script(part, panels, layout);

  // A gnuplot that ends early closes the pipe, which would otherwise end this program without a word.
  const auto previous_handler = std::signal(SIGPIPE, SIG_IGN);
  int status = -1;
  bool sent = false;
  if (std::FILE* const pipe = popen("gnuplot >/dev/null 2>&1", "w")) {
    sent =
        std::fwrite(commands.data(), 1, commands.size(), pipe) == commands.size() && std::fflush(pipe) == 0;
    status = pclose(pipe);
  }
  std::signal(SIGPIPE, previous_handler);

  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(part, ignored);
  if (!sent || status != 0 || ignored || bytes == 0) {
    std::filesystem::remove(part, ignored);
    throw std::runtime_error("gnuplot could not draw " + path.filename().string());
  }
  std::filesystem::rename(part, path);
}

}  // namespace examples
