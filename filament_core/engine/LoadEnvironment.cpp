// SPDX-License-Identifier: Apache-2.0
#include "base/OutOfMemory.h"
#include "filament_core/engine/EnvironmentImpl.h"
#include "filament_core/engine/SharedBytes.h"

#include <new>
#include <utility>

namespace filament_core {

using engine::PublicCall;

namespace {

template <class Handle>
Handle orBadAlloc(Handle handle) {
    return handle ? handle : throw std::bad_alloc();
}

/// Gives its texels away.
Texture uploadCube(Engine::Impl& engine, assets::Image& image, std::string name) {
    const engine::SharedBytes texels = engine::sharedBytes(image.data);
    return engine.createTexture({ .kind = TextureKind::Cube,
                                  .format = image.format,
                                  .width = image.width,
                                  .height = image.height,
                                  .layers = 6,
                                  .levels = image.levels,
                                  .pixels = *texels,
                                  .name = std::move(name) },
                                texels);
}

} // namespace

Environment::Impl::~Impl() {
    if (!link.isAlive()) return;
    Engine& owner = Engine::of(engine);
    owner.destroy(skybox);
    owner.destroy(indirectLight);
    for (const Texture texture : { irradiance, sky, specular }) owner.destroy(texture);
}

namespace engine {

EnvironmentUpload::EnvironmentUpload(Engine::Impl& engine, assets::EnvironmentData data, std::string name)
        : mEngine(engine), mData(std::move(data)), mName(std::move(name)),
          mParts(new Environment::Impl{ engine, EngineLink(engine) }) {}

size_t EnvironmentUpload::step(size_t index) {
    assets::Image& image = index == 0 ? mData.specular : index == 1 ? mData.sky : mData.irradiance;
    if (image.data.empty()) return 0; // of the irradiance only coefficients may be known
    constexpr const char* kSuffixes[kSteps] = { "", " sky", " irradiance" };
    Texture& texture = index == 0 ? mParts->specular : index == 1 ? mParts->sky : mParts->irradiance;
    const size_t bytes = image.data.size();
    texture = uploadCube(mEngine, image, mName + kSuffixes[index]);
    return bytes;
}

Environment EnvironmentUpload::finish() {
    Engine& engine = Engine::of(mEngine);
    mParts->indirectLight = orBadAlloc(engine.create(IndirectLightDesc{ .specular = mParts->specular,
                                                                        .specularLevels = mData.specular.levels,
                                                                        .mapping = mData.mapping,
                                                                        .irradiance = mParts->irradiance,
                                                                        .irradianceSh = mData.irradianceSh,
                                                                        .worldFromCube = mData.worldFromCube,
                                                                        .name = mName }));
    mParts->skybox = orBadAlloc(
            engine.create(SkyboxDesc{ .cube = mParts->sky, .worldFromCube = mData.worldFromCube, .name = mName }));
    mParts->lights = mData.lights;
    return Environment(std::move(mParts));
}

Environment uploadEnvironment(Engine& engine, assets::EnvironmentData data, std::string name) {
    EnvironmentUpload upload(engine.impl(), std::move(data), std::move(name));
    for (size_t i = 0; i < EnvironmentUpload::kSteps; ++i) upload.step(i);
    return upload.finish();
}

/// Of the textures that store it.
Format textureFormat(EnvironmentFormat format) {
    switch (format) {
    case EnvironmentFormat::Rgba16F:
        break;
    case EnvironmentFormat::R11G11B10F:
        return Format::R11G11B10F;
    case EnvironmentFormat::Rgb9E5:
        return Format::RGB9E5;
    case EnvironmentFormat::Rgbm:
        return Format::RGBA8;
    }
    return Format::RGBA16F;
}

assets::EnvironmentOptions environmentOptions(Engine::Impl const& engine, EnvironmentLoadOptions const& options) {
    return { .cacheDirectory = engine.options.cacheDirectory,
             .faceSize = options.faceSize,
             .samples = options.samples,
             .format = textureFormat(options.format),
             .mapping = options.roughnessMapping,
             .sun = options.sun,
             .lights = options.lights,
             .progress = options.progress };
}

} // namespace engine

IndirectLight Environment::indirectLight() const {
    const PublicCall call(mImpl, "Environment::indirectLight()");
    return mImpl->indirectLight;
}
Skybox Environment::skybox() const {
    const PublicCall call(mImpl, "Environment::skybox()");
    return mImpl->skybox;
}
EnvironmentLights const& Environment::lights() const {
    const PublicCall call(mImpl, "Environment::lights()");
    return mImpl->lights;
}

Result<Environment> loadEnvironment(Engine& engine, std::filesystem::path const& path,
                                    EnvironmentLoadOptions const& options) {
    const PublicCall call(engine, "loadEnvironment(Engine, path)", path.native());
    return orOutOfMemory("environment", path.native(), [&]() -> Result<Environment> {
        Engine::Impl& impl = engine.impl();
        auto data = assets::loadEnvironment(path, impl.jobs, engine::environmentOptions(impl, options));
        if (!data) return data.error();
        Environment environment = engine::uploadEnvironment(engine, std::move(*data), path.filename().string());
        impl.flush(); // the driver thread uploads while the caller continues
        return environment;
    });
}

Result<Environment> loadEnvironment(Engine& engine, std::span<const std::byte> file, std::string_view name,
                                    EnvironmentLoadOptions const& options) {
    const PublicCall call(engine, "loadEnvironment(Engine, span<byte>, string_view)", name);
    return orOutOfMemory("environment", name, [&]() -> Result<Environment> {
        Engine::Impl& impl = engine.impl();
        auto data = assets::loadEnvironmentFromMemory(file, name, impl.jobs, engine::environmentOptions(impl, options));
        if (!data) return data.error();
        Environment environment = engine::uploadEnvironment(engine, std::move(*data), std::string(name));
        impl.flush();
        return environment;
    });
}

} // namespace filament_core
