// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/page/ScenePictures.h"

#include "filament_core/assets/tables/DisplayColor.h"

#include <filament_core/Engine.h>
#include <filament_core/Environment.h>
#include <filament_core/Gltf.h>
#include <filament_core/Renderer.h>
#include <filament_core/Scene.h>

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::bake {
namespace {

Result<Engine> openEngine() {
    Result<Engine> vulkan = Engine::create({ .backend = Backend::Vulkan });
    if (vulkan) return vulkan;
    Result<Engine> gles = Engine::create({ .backend = Backend::Gles });
    return gles ? std::move(gles) : std::move(vulkan);
}

/// Draws with one engine.
class Painter {
public:
    Painter(Engine& engine, Options const& options, Camera const& camera)
            : mEngine(engine), mOptions(options), mRenderer(engine) {
        mView.camera = camera;
        mView.size = options.report.size;
    }

    Result<tools::Picture> draw(std::filesystem::path const& path, IrradianceGridDesc const* grid, bool hasLamps) {
        Result<Model> model = loadGltf(mEngine, path);
        if (!model) return model.error();
        Scene scene(mEngine);
        const Node node = scene.add(*model);
        if (!hasLamps) scene.setLightChannels(node, kNoLamps);
        if (mOptions.sun && hasLamps) scene.add(LightDesc(*mOptions.sun));
        if (grid) scene.add(*grid);
        if (const Result<void> lit = addEnvironment(scene, *model); !lit) return lit.error();
        const Owned<SwapChain> target = mEngine.own(mEngine.create(
                SwapChainDesc{ .size = mView.size, .imageCount = 1, .format = Format::RGBA16F, .name = "report" }));
        mRenderer.render(scene, mView, target);
        const Result<Image> image = mRenderer.waitPixels(mRenderer.readPixels(target));
        if (!image) return image.error();
        if (const auto errors = mEngine.takeErrors(); !errors.empty())
            return fail(ErrorCode::DeviceLost, "the device reported: {}", errors.front());
        return tools::pictureOf(*image);
    }

private:
    static constexpr LightChannels kNoLamps{ 0 }; // they are baked

    Result<void> addEnvironment(Scene& scene, Model const& model) {
        const EnvironmentSettings settings{ .illuminance = mOptions.iblIntensity,
                                            .rotationRadians =
                                                    static_cast<float>(glm::radians(mOptions.rotationDegrees)),
                                            .skybox = false };
        if (mOptions.environment.empty()) {
            if (model.environment()) scene.setEnvironment(*model.environment(), settings);
            return {};
        }
        if (mOptions.environment == "none") return {};
        if (!mEnvironment) {
            Result<Environment> loaded = loadEnvironment(mEngine, mOptions.environment);
            if (!loaded) return loaded.error();
            mEnvironment.emplace(std::move(*loaded));
        }
        scene.setEnvironment(*mEnvironment, settings);
        return {};
    }

    Engine& mEngine;
    Options const& mOptions;
    Renderer mRenderer;
    std::optional<Environment> mEnvironment;
    View mView;
};

/// Both images of the engine; what is missing then is `pictures.problem`.
Result<void> drawBoth(Options const& options, Camera const& camera, BakedParts const& baked,
                      tools::Picture const& standardError, ScenePictures& pictures) {
    Result<Engine> engine = openEngine();
    if (!engine) return engine.error();
    pictures.device = engine->device().device;
    Painter painter(*engine, options, camera);
    const auto judged = [&](tools::Picture picture) {
        const tools::BlockErrors errors = blockErrors(picture, pictures.traced, standardError);
        return EnginePicture{ std::move(picture), errors };
    };
    Result<tools::Picture> before = painter.draw(options.model, nullptr, true);
    if (!before) return before.error();
    pictures.before = judged(std::move(*before));
    Result<tools::Picture> after =
            painter.draw(baked.model.empty() ? options.model : baked.model, baked.grid ? &*baked.grid : nullptr,
                         baked.grid || !options.light.directLight);
    if (!after) return after.error();
    pictures.after = judged(std::move(*after));
    return {};
}

} // namespace

Result<ScenePictures> drawScene(Options const& options, Camera const& camera, reference::TracedScene const& scene,
                                BakedParts const& baked, jobs::JobSystem& jobs) {
    ScenePictures pictures;
    Result<reference::ReferenceImage> image = render(scene, { .camera = camera, .size = options.report.size },
                                                     { .samplesPerPixel = options.report.samples,
                                                       .seed = options.light.seed,
                                                       .filter = reference::PixelFilter::Center },
                                                     jobs);
    if (!image) return image.error();
    pictures.traced = { image->width, image->height, std::move(image->color) };
    const tools::Picture standardError{ image->width, image->height, std::move(image->standardError) };
    if (const Result<void> drawn = drawBoth(options, camera, baked, standardError, pictures); !drawn)
        pictures.problem = drawn.error().message;
    return pictures;
}

Image shownImage(tools::Picture const& picture) {
    const assets::DisplayColor display(DisplayTransform{});
    Image image{ .width = picture.width, .height = picture.height, .format = Format::RGBA8 };
    image.pixels.reserve(picture.pixels.size() * 4);
    for (float3 const& pixel : picture.pixels) {
        const float3 shown = display(pixel);
        for (int c = 0; c < 3; ++c)
            image.pixels.push_back(static_cast<std::byte>(std::lround(std::clamp(shown[c], 0.0f, 1.0f) * 255)));
        image.pixels.push_back(std::byte{ 255 });
    }
    return image;
}

} // namespace filament_core::bake
