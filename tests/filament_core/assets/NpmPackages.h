// SPDX-License-Identifier: Apache-2.0
/// Programs and libraries of other authors that write what ours reads, from npm.
#pragma once

#include "toolkit/paths/Paths.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace filament_core::assets {

inline int shell(std::string const& command) { return std::system(command.c_str()); }

/// Installs packages ("name@version other@version") into a folder of the build, once; offline if npm's cache has them.
/// Returns the folder; empty without node, npm or its registry.
inline std::filesystem::path npmFolder(std::string const& name, std::string const& packages) {
    if (shell("node --version > /dev/null 2>&1") != 0) return {};
    const std::filesystem::path folder = tools::buildDir() / name;
    std::string marker = "has " + packages;
    std::ranges::replace(marker, '/', '-');
    const std::filesystem::path done = folder / marker;
    if (std::filesystem::exists(done)) return folder;
    std::filesystem::create_directories(folder);
    if (shell("timeout 180 npm install --prefix '" + folder.string() +
              "' --prefer-offline --fetch-retries=0 --no-audit --no-fund " + packages + " > /dev/null 2>&1") != 0)
        return {};
    return std::ofstream(done) ? folder : std::filesystem::path{}; // last: what was interrupted is installed again
}

} // namespace filament_core::assets
