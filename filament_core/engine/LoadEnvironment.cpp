// SPDX-License-Identifier: Apache-2.0
#include "base/OutOfMemory.h"
#include "filament_core/engine/EnvironmentImpl.h"

#include <new>

namespace filament {

using engine::PublicCall;

namespace {

template <class Handle>
Handle orBadAlloc(Handle handle) {
    return handle ? handle : throw std::bad_alloc();
}

Texture uploadCube(Engine::Impl& engine, assets::Image const& image, std::string name) {
    return engine.createTexture({ .kind = TextureKind::Cube,
                                  .format = image.format,
                                  .width = image.width,
                                  .height = image.height,
                                  .layers = 6,
                                  .levels = image.levels,
                                  .pixels = image.data,
                                  .name = std::move(name) });
}

} // namespace

Environment::Impl::~Impl() {
    if (!link.isAlive()) return;
    Engine& owner = Engine::of(engine);
    owner.destroy(skybox);
    owner.destroy(indirectLight);
    for (const Texture texture : { irradiance, sky, specular }) owner.destroy(texture);
}

Environment engine::uploadEnvironment(Engine& engine, assets::EnvironmentData const& data, std::string const& name) {
    Engine::Impl& impl = engine.impl();
    std::unique_ptr<Environment::Impl> parts(new Environment::Impl{ impl, engine::EngineLink(engine) });
    parts->specular = uploadCube(impl, data.specular, name);
    parts->sky = uploadCube(impl, data.sky, name + " sky");
    if (!data.irradiance.data.empty()) parts->irradiance = uploadCube(impl, data.irradiance, name + " irradiance");
    parts->indirectLight = orBadAlloc(engine.create(IndirectLightDesc{ .specular = parts->specular,
                                                                       .specularLevels = data.specular.levels,
                                                                       .mapping = data.mapping,
                                                                       .irradiance = parts->irradiance,
                                                                       .irradianceSh = data.irradianceSh,
                                                                       .worldFromCube = data.worldFromCube,
                                                                       .name = name }));
    parts->skybox = orBadAlloc(
            engine.create(SkyboxDesc{ .cube = parts->sky, .worldFromCube = data.worldFromCube, .name = name }));
    return Environment(std::move(parts));
}

Environment::Environment(std::unique_ptr<Impl> impl) : mImpl(std::move(impl)) {}
Environment::Environment(Environment&&) noexcept = default;
Environment& Environment::operator=(Environment&&) noexcept = default;
Environment::~Environment() = default;

IndirectLight Environment::indirectLight() const {
    const PublicCall call(mImpl, "Environment::indirectLight()");
    return mImpl->indirectLight;
}
Skybox Environment::skybox() const {
    const PublicCall call(mImpl, "Environment::skybox()");
    return mImpl->skybox;
}

Result<Environment> loadEnvironment(Engine& engine, std::filesystem::path const& path,
                                    EnvironmentLoadOptions const& options) {
    const PublicCall call(engine, "loadEnvironment(Engine, path)", path.native());
    return orOutOfMemory("environment", path.native(), [&]() -> Result<Environment> {
        Engine::Impl& impl = engine.impl();
        auto data = assets::loadEnvironment(path, impl.jobs,
                                            { .cacheDirectory = impl.options.cacheDirectory,
                                              .faceSize = options.faceSize,
                                              .samples = options.samples,
                                              .format = options.format,
                                              .mapping = options.roughnessMapping,
                                              .progress = options.progress });
        if (!data) return data.error();
        Environment environment = engine::uploadEnvironment(engine, *data, path.filename().string());
        impl.flush(); // the driver thread uploads while the caller continues
        return environment;
    });
}

} // namespace filament
