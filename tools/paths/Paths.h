// SPDX-License-Identifier: Apache-2.0
/// Where this checkout and its build lie: for tests, tools and benches, which read the tree that they were built from.
/// Functions of one library, because a path in a compiler's options would keep its cache from serving two checkouts.
///   Thread  any. Errors: none; a folder may be gone.
#pragma once

#include <filesystem>

namespace filament::tools {

std::filesystem::path sourceDir();  ///< the root of the repository
std::filesystem::path buildDir();   ///< CMake's, with bin/ and generated/
std::filesystem::path assetDir();   ///< FILAMENT_ASSET_DIR: glTF models and environments; empty if there is none
std::filesystem::path plotPython(); ///< an interpreter that has matplotlib

} // namespace filament::tools
