// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Options.h"

#include "toolkit/program/CommandLine.h"

namespace filament_core::bake {

Result<std::optional<Options>> parseOptions(int argc, const char* const* argv) {
    Options options;
    std::string threads;
    tools::CommandLine app{ "Bakes the light of a scene that does not move into textures.", "filament-bake" };
    app.option("MODEL", options.model, ".gltf or .glb").required();
    app.option("--out", options.out, "folder for what is written (out)");
    app.option("--threads", threads, "number of tracing threads (one per core)");
    const Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return parsed.error();
    if (!*parsed) return std::optional<Options>{};
    if (!threads.empty()) {
        const auto count = tools::wholeNumber(threads, 1, 256);
        if (!count) return tools::invalidOption("--threads", threads, "a whole number from 1 to 256");
        options.workers = static_cast<int>(*count) - 1; // this thread works, too
    }
    return std::optional(std::move(options));
}

} // namespace filament_core::bake
