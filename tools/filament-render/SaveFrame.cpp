// SPDX-License-Identifier: Apache-2.0
#include "tools/filament-render/SaveFrame.h"

#include "toolkit/json/JsonFile.h"
#include "toolkit/program/Console.h"
#include "toolkit/record/SavedFrame.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace filament_core::tools {
namespace {

std::string settingsOf(Options const& options, showcase::Files const& files) {
    return jsonText({ { "arguments", options.arguments },
                      { "model", files.model.string() },
                      { "environment", files.environment.string() } },
                    -1);
}

} // namespace

Result<void> saveRunAsFrame(Options const& options, showcase::Files const& files, std::span<const BackendRun> runs) {
    if (options.saveFrame.empty() || runs.empty()) return {};
    Options drawn = options;
    if (runs[0].decision) drawn.view.quality = runs[0].decision->quality;
    const OutputSpace space = options.view.display.outputSpace;
    record::SaveRequest request{ .folder = options.saveFrame,
                                 .shown = { { .image = runs[0].image, .space = space } },
                                 .engine = engineOptionsOf(options),
                                 .program = "filament-render",
                                 .settings = settingsOf(options, files) };
    request.recipe = [&](Engine& engine) -> Result<std::vector<record::FramePicture>> {
        Result<Image> image = drawPicture(engine, drawn, files.model, files.environment);
        if (!image) return image.error();
        std::vector<record::FramePicture> pictures(1);
        pictures[0].image = std::move(*image);
        pictures[0].space = space;
        return pictures;
    };
    const Result<record::Manifest> saved = record::saveFrame(request);
    clearProgress();
    if (!saved) return saved.error();
    std::printf("saved   %s: filament-replay draws it again\n", options.saveFrame.c_str());
    for (record::AbsentBackend const& absent : saved->absent)
        printWarning(fmt::format("--save-frame: {} is missing: {}", toString(absent.backend), absent.reason));
    for (record::TraceRecord const& trace : saved->traces) {
        if (!trace.problem.empty())
            return fail(ErrorCode::Internal, "--save-frame: {} does not draw the frame again: {}",
                        toString(trace.backend), trace.problem);
    }
    return {};
}

} // namespace filament_core::tools
