/// The version of incognita, for conditional compilation. The one place that says it: CMake reads these three
/// numbers. Before 1.0.0 a new minor version may break its users; from then on only a new major version may.
#pragma once

/// Changes when programs must be rewritten.
#define INCOGNITA_VERSION_MAJOR 0
/// Changes when there is something new; before 1.0, also when programs must be rewritten.
#define INCOGNITA_VERSION_MINOR 1
/// Changes when something is mended.
#define INCOGNITA_VERSION_PATCH 0
