/// The report of one run, or of two side by side, as a page of HTML that needs nothing but itself.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/report_data.hpp"
#include "support/report_parts.hpp"

namespace examples {

/// Text as HTML shows it.
[[nodiscard]] inline std::string escaped(std::string_view text) {
  std::string html;
  for (const char letter : text) {
    switch (letter) {
      case '&': html += "&amp;"; break;
      case '<': html += "&lt;"; break;
      case '>': html += "&gt;"; break;
      case '"': html += "&quot;"; break;
      default: html += letter;
    }
  }
  return html;
}

/// The page; `runs` are one or two. Throws as report_data does, and std::invalid_argument for another number of runs.
[[nodiscard]] inline std::string report_html(const std::vector<ReportRun>& runs, const ReportLimits& limits = {}) {
  incognita::require(runs.size() == 1 || runs.size() == 2, "report_html", "runs", static_cast<double>(runs.size()), "1 or 2");
  std::string title = escaped(runs.front().name);
  std::string data;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    if (run > 0) title += " and " + escaped(runs[run].name);
    data += "<script type=\"application/octet-stream\" class=\"run\">" + base64(deflated(report_data(runs[run], limits))) + "</script>\n";
  }
  const std::pair<std::string_view, std::string_view> parts[] = {{"{{title}}", title},
                                                                 {"{{style}}", report_style()},
                                                                 {"{{runs}}", data},
                                                                 {"{{library}}", report_library()},
                                                                 {"{{script}}", report_script()}};
  std::string page;
  std::string_view rest = report_template();
  for (const auto& [mark, part] : parts) {
    const std::size_t at = rest.find(mark);
    page += rest.substr(0, at);
    page += part;
    rest.remove_prefix(at + mark.size());
  }
  page += rest;
  return page;
}

}  // namespace examples
