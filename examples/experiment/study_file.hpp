/// Reading studies from TOML files. docs/experiments/README.md says what may stand in one.
#pragma once

#include <filesystem>

#include "experiment/study.hpp"

namespace experiment {

/// Reads one study. `data` is where maps are looked for that do not lie beside it. Throws InputError "FILE:LINE: what is wrong".
[[nodiscard]] Study read_study(const std::filesystem::path& file, const std::filesystem::path& data);

}  // namespace experiment
