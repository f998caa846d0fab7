/// Line charts as PNG, drawn by gnuplot: a value that describes a chart, and a function that draws several
/// side by side.
#pragma once

#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace examples {

/// How a series is drawn.
enum class Stroke { solid, dashed, points };

/// One curve. x and y have the same length; where y is NaN the curve has a gap.
struct Series {
  std::string name = {};  ///< in the legend; none when empty
  std::vector<double> x = {};
  std::vector<double> y = {};
  std::string color = "#000000";
  Stroke stroke = Stroke::solid;
  double width = 2.0;
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
    text << "with lines lw " << series.width << (series.stroke == Stroke::dashed ? " dt (8,5)" : " dt 1");
  }
  text << " lc rgb " << quoted(series.color);
  return text.str();
}

/// gnuplot's commands for all panels in one row.
inline std::string script(const std::filesystem::path& path, const std::vector<Chart>& panels) {
  std::ostringstream out;
  out.precision(10);
  std::size_t block = 0;
  for (const Chart& chart : panels) {
    for (const Series& series : chart.series) {
      if (series.x.size() != series.y.size()) {
        throw std::invalid_argument("chart: series '" + series.name + "' has x and y of different lengths");
      }
      out << "$series" << block++ << " << END\n";
      for (std::size_t i = 0; i < series.x.size(); ++i) out << series.x[i] << ' ' << series.y[i] << '\n';
      out << "END\n";
    }
  }
  out << "set encoding utf8\n"
      << "set terminal pngcairo noenhanced size " << 800 * panels.size() << ",640 font 'DejaVu Sans,14'\n"
      << "set output " << quoted(path.string()) << "\n"
      << "set multiplot layout 1," << panels.size() << "\n"
      << "set border 3 lw 1.2\nset tics nomirror out\nset grid lw 0.8 lc rgb '#dddddd' lt 1\n"
      << "set format '%g'\nset title offset 0,-0.4\n";
  block = 0;
  for (const Chart& chart : panels) {
    const std::string place = (chart.legend.starts_with("below") ? "" : "inside ") + chart.legend;
    out << "set title " << quoted(chart.title) << "\nset xlabel " << quoted(chart.x_label) << "\nset ylabel "
        << quoted(chart.y_label) << "\nset xrange " << range(chart.x_range) << "\nset yrange "
        << range(chart.y_range) << "\nset size " << (chart.equal_axes ? "ratio -1" : "noratio") << "\n"
        << (chart.legend.starts_with("below") ? "set bmargin 6.5\n" : "set bmargin\n")
        << (chart.legend == "off" ? "unset key"
                                  : "set key " + place + " reverse Left samplen 2.5 spacing 1.1")
        << "\n";
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
      const Series& series = chart.series[i];
      out << (i == 0 ? "plot " : ", ") << "$series" << block++ << " using 1:2 " << style(series)
          << (series.name.empty() ? " notitle" : " title " + quoted(series.name));
    }
    out << "\n";
  }
  out << "unset multiplot\nunset output\n";
  return out.str();
}

}  // namespace detail

/// Draws the panels side by side into the PNG file `path`, which is replaced only when complete. Throws
/// std::invalid_argument when a series is malformed and std::runtime_error, in one line, when gnuplot is
/// missing or fails. Not thread safe: it ignores SIGPIPE while gnuplot runs.
inline void write_chart_png(const std::filesystem::path& path, const std::vector<Chart>& panels) {
  require_gnuplot();
  const std::filesystem::path part = path.string() + ".part";
  const std::string commands = detail::script(part, panels);

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
