// SPDX-License-Identifier: Apache-2.0
/// The locations of this checkout and its build, for tests, tools and benches, which read the tree they were built
/// from. Functions of one library, because paths in compiler options would keep the compiler cache from serving two
/// checkouts.
///   Thread  any. Errors: none; a folder may no longer exist.
#pragma once

#include <filesystem>

namespace filament_core::tools {

std::filesystem::path sourceDir();  ///< the root of the repository
std::filesystem::path buildDir();   ///< CMake's, with bin/ and generated/
std::filesystem::path assetDir();   ///< FILAMENT_ASSET_DIR: glTF models and environments; empty if there is none
std::filesystem::path plotPython(); ///< an interpreter with matplotlib

} // namespace filament_core::tools
