// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/FrameSaver.h"

#include "toolkit/record/SavedFrame.h"
#include "tools/view/stage/Stage.h"

#include <fmt/format.h>

namespace filament_core::view {
namespace {

Result<std::vector<record::FramePicture>> drawOn(Engine& engine, Document const& document) {
    const std::unique_ptr<Stage> stage = Stage::on(engine, { .watchesFiles = false });
    stage->apply(document);
    stage->finishLoading();
    Result<Image> image = stage->renderToImage();
    if (!image) return image.error();
    std::vector<record::FramePicture> pictures;
    pictures.push_back({ .image = std::move(*image), .space = document.view.display.outputSpace });
    return pictures;
}

std::vector<std::string> save(std::filesystem::path const& folder, Document const& document, Image shown, int workers) {
    record::SaveRequest request;
    request.folder = folder;
    request.recipe = [&document](Engine& engine) { return drawOn(engine, document); };
    request.shown.push_back({ .image = std::move(shown), .space = document.view.display.outputSpace });
    request.engine.workers = workers;
    request.program = "filament-view";
    request.settings = toJson(document);
    const Result<record::Manifest> saved = record::saveFrame(request);
    if (!saved) return { saved.error().message };
    std::vector<std::string> lines = record::problemsOf(*saved);
    lines.insert(lines.begin(), fmt::format("saved {}; filament-replay draws it again", folder.string()));
    return lines;
}

} // namespace

bool FrameSaver::start(std::filesystem::path folder, Document document, Image shown, int workers) {
    if (isBusy()) return false;
    mSaved.emplace(
            [=, shown = std::move(shown)]() mutable { return save(folder, document, std::move(shown), workers); });
    return true;
}

} // namespace filament_core::view
