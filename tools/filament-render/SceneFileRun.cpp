// SPDX-License-Identifier: Apache-2.0
#include "tools/filament-render/SceneFileRun.h"

#include "toolkit/materials/MaterialFile.h"
#include "tools/filament-render/GltfFile.h"

#include <filament_core/BuildScene.h>

namespace filament_core::tools {
namespace {

Result<SceneFile> editedFile(Options const& options) {
    Result<SceneFile> file = SceneFile::load(options.model);
    if (!file) return file;
    for (auto const& [key, value] : options.sceneEdits)
        if (const Result<void> set = file->set(key, value); !set)
            return fail(set.error().code, "--set {}={}: {}", key, value, set.error().message);
    return file;
}

/// The package of the text of a material.
Result<std::vector<std::byte>> compiled(std::filesystem::path const& file) {
    const Result<std::shared_ptr<const MaterialFile>> material = readMaterialFile(file);
    if (!material) return material.error();
    return (*material)->bytes;
}

Format formatOf(PictureFormat picture, bool isLinear) {
    if (picture == PictureFormat::Exr || isLinear) return Format::RGBA16F;
    return picture == PictureFormat::Png16 ? Format::RGB10A2 : Format::RGBA8;
}

} // namespace

bool isSceneFile(std::filesystem::path const& file) { return file.extension() == ".json"; }

Result<BackendRun> runSceneFile(Options const& options, Backend backend) {
    const Result<SceneFile> file = editedFile(options);
    if (!file) return file.error();
    if (file->contents().isLinear && options.format != PictureFormat::Exr)
        return fail(ErrorCode::InvalidArgument, "--format: '{}' is scene-linear; give --format exr",
                    options.model.string());
    EngineOptions engineOptions = engineOptionsOf(options);
    engineOptions.backend = backend;
    Result<Engine> engine = Engine::create(engineOptions);
    if (!engine) return engine.error();
    Result<BuiltScene> built = buildScene(*engine, *file, { .compile = compiled });
    if (!built) return built.error();
    BackendRun run{ .backend = backend, .device = engine->device(), .modelName = file->name() };
    for (Model const& model : built->models)
        run.warnings.insert(run.warnings.end(), model.warnings().begin(), model.warnings().end());
    if (built->environment) run.lights = built->environment->lights();
    const uint2 size = file->contents().target.x > 0 ? file->contents().target : built->view.size;
    const Owned<SwapChain> target =
            engine->own(engine->create(SwapChainDesc{ .size = size,
                                                      .imageCount = 1,
                                                      .format = formatOf(options.format, file->contents().isLinear),
                                                      .name = "scene file" }));
    Renderer renderer(*engine);
    drawFrames(*engine, renderer, *built, target);
    Result<Image> image = renderer.waitPixels(renderer.readPixels(target));
    if (!image) return image.error();
    run.image = std::move(*image);
    run.explanation = renderer.explain();
    run.statistics = renderer.statistics();
    if (Result<void> saved =
                saveGltfFile(options, backend, built->scene, built->view.camera, file->contents().environment.file);
        !saved)
        return saved.error();
    run.errors = engine->takeErrors();
    return run;
}

} // namespace filament_core::tools
