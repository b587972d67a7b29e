// SPDX-License-Identifier: Apache-2.0
#include "toolkit/paths/Paths.h"

namespace filament_core::tools {

std::filesystem::path sourceDir() { return FILAMENT_SOURCE_DIR; }
std::filesystem::path buildDir() { return FILAMENT_BINARY_DIR; }
std::filesystem::path assetDir() { return FILAMENT_ASSET_DIR; }
std::filesystem::path plotPython() { return FILAMENT_PLOT_PYTHON; }

} // namespace filament_core::tools
