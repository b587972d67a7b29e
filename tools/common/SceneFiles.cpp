// SPDX-License-Identifier: Apache-2.0
#include "tools/common/SceneFiles.h"

#include "tools/common/Console.h"

namespace filament::tools {

Result<void> makeOutFolder(SceneOptions const& options) {
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (std::filesystem::is_directory(options.out)) return {};
    return fail(ErrorCode::Unreadable, "--out '{}': not a folder that can be made ({}); give another one",
                options.out.string(), error ? error.message() : "there is a file of that name");
}

Result<showcase::Files> chooseFiles(SceneOptions const& options) {
    if (!options.model.empty()) return showcase::Files{ options.model, options.environment };
    showProgress("making the showcase");
    jobs::JobSystem jobs;
    Result<showcase::Files> files = showcase::writeFiles(options.out, jobs);
    if (files && !options.environment.empty()) files->environment = options.environment;
    return files;
}

} // namespace filament::tools
