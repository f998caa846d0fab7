/// The version of incognita, for conditional compilation. The one place that says it: CMake reads these three
/// numbers. Before 1.0.0 a new minor version may break its users; from then on only a new major version may.
#pragma once

#define INCOGNITA_VERSION_MAJOR 0
#define INCOGNITA_VERSION_MINOR 1
#define INCOGNITA_VERSION_PATCH 0
