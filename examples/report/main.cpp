// Makes a page of a recorded run, or of two side by side: a replay, plots over time, metrics and parameters, in one file of HTML.
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/io/atomic_file.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/recording_file.hpp"
#include "report/options.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"
#include "support/report_html.hpp"

namespace report {
namespace {

/// A recording of the usual name is called by its folder.
std::string name_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = std::filesystem::absolute(file).lexically_normal().parent_path().filename();
  return file.stem() == "recording" && !folder.empty() ? folder.string() : file.stem().string();
}

void run(const Options& options) {
  // All input is read before anything is written.
  std::vector<examples::ReportRun> runs;
  for (const std::string& file : options.recordings) {
    runs.push_back({name_of(file), incognita::read_recording(file)});
    // The page must be able to show each of them.
    try {
      static_cast<void>(examples::report_data(runs.back()));
    } catch (const std::length_error& error) {
      throw incognita::InputError(std::filesystem::path(file), error.what());
    }
  }
  std::filesystem::path file = options.output;
  if (file.extension() != ".html") file /= "report.html";
  const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
  examples::OutputFolder output(folder, {file.filename().string()});
  const std::string page = examples::report_html(runs);
  incognita::write_file_atomically(output.staged(file.filename().string()), page);
  output.publish();
  if (options.quiet) return;
  std::printf("The report is %s (%.1f MB)\n", file.string().c_str(), static_cast<double>(page.size()) / 1e6);
}

}  // namespace
}  // namespace report

int main(int argc, char** argv) {
  CLI::App app(
      "Makes one page of HTML, which needs nothing but a browser, of a recorded run: a replay of the belief with the\n"
      "true walls, the scans, the frontiers and the candidates between which was decided; plots over time; metrics and\n"
      "parameters. --compare puts two runs side by side.");
  return examples::run_program("report", app, [&] { report::run(report::parse_options(app, argc, argv)); });
}
