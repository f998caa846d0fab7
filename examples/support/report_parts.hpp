/// The parts of the report page, which the build makes of the files in examples/report/page and of Chart.js.
#pragma once

#include <string_view>

namespace examples {

[[nodiscard]] std::string_view report_template();
[[nodiscard]] std::string_view report_style();
[[nodiscard]] std::string_view report_library();
[[nodiscard]] std::string_view report_script();

}  // namespace examples
