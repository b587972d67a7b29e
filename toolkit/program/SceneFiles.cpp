// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/SceneFiles.h"

#include "toolkit/program/Console.h"

namespace filament_core::tools {

Result<void> makeOutFolder(SceneOptions const& options) {
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (std::filesystem::is_directory(options.out)) return {};
    return fail(ErrorCode::Unreadable, "--out '{}': the folder cannot be created ({}); give another one",
                options.out.string(), error ? error.message() : "there is a file of that name");
}

Result<showcase::Files> chooseFiles(SceneOptions const& options) {
    const std::filesystem::path environment = options.environment == "none" ? "" : options.environment;
    const bool isDark = options.environment.empty() && !options.sun;
    if (!options.model.empty() && !isDark) return showcase::Files{ options.model, environment };
    jobs::JobSystem jobs;
    if (!options.model.empty()) {
        const Result<std::filesystem::path> sky = showcase::writeSky(options.out, jobs);
        if (!sky) return sky.error();
        return showcase::Files{ options.model, *sky };
    }
    showProgress("making the showcase");
    Result<showcase::Files> files = showcase::writeFiles(options.out, jobs);
    if (files && !options.environment.empty()) files->environment = environment;
    return files;
}

} // namespace filament_core::tools
