/// Reading studies from TOML files. docs/experiments/README.md says what may stand in one.
#pragma once

#include <filesystem>

#include "experiment/study.hpp"

namespace experiment {

/// Reads one study. `data` is where maps are looked for that do not lie beside it, `shipped` where studies are that it may be like. Throws InputError
/// "FILE:LINE: what is wrong".
[[nodiscard]] Study read_study(const std::filesystem::path& file, const std::filesystem::path& data, const std::filesystem::path& shipped = {});

}  // namespace experiment
