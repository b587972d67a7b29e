// SPDX-License-Identifier: Apache-2.0
/// The command line of matc. Flags as in the materials guide, 5.2.
///   Fails   parseOptions(): for a usage error, after printing it, with kUsage; for --help and --version with 0.
#pragma once

#include "filament_core/assets/files/PathInside.h"
#include "shaders/compiler/Templates.h"

#include <string>
#include <utility>
#include <vector>

namespace filament_core::matc {

/// What a run ends with.
enum Status : int {
    kDone = 0,   ///< written, or printed
    kFailed = 1, ///< the material, one of its files, or the output
    kUsage = 2,  ///< the command line
};

struct Options {
    std::string input;  ///< "-": the standard input
    std::string output; ///< the package
    std::string api = "all";
    std::string reflect;
    std::string platform = "all";
    std::string dependencyFile; ///< where to write a rule for make; empty: nowhere
    std::vector<std::string> filters;
    std::vector<std::pair<std::string, std::string>> defines;
    shader::TemplateValues templates;
    int threads = 0;
    bool optimizeSize = false, noOptimization = false, inexact = false, preprocess = false, cost = false;
    bool printDependencies = false, warn = true;
    assets::FilesFrom includes = assets::FilesFrom::Folder;

    bool readsStandardInput() const { return input == "-"; }
    bool isDispatch() const { return input.ends_with(".comp"); }
};

/// The options of each material, at least one, or the status with which to end.
struct Parsed {
    std::vector<Options> materials;
    int status = kDone;
};
Parsed parseOptions(int argc, char** argv);

} // namespace filament_core::matc
