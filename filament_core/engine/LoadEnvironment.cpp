// SPDX-License-Identifier: Apache-2.0
#include <filament/Environment.h>

#include "base/OutOfMemory.h"
#include "filament_core/assets/environment/Environment.h"
#include "filament_core/engine/EngineImpl.h"

#include <new>

namespace filament {

struct Environment::Impl {
    Engine::Impl& engine;
    Texture specular{}, sky{}, irradiance{};
    IndirectLight indirectLight{};
    Skybox skybox{};

    ~Impl() {
        Engine& owner = Engine::of(engine);
        if (skybox) owner.destroy(skybox); // null: memory ran out while the environment was loaded
        if (indirectLight) owner.destroy(indirectLight);
        if (irradiance) engine.destroy(irradiance);
        if (sky) engine.destroy(sky);
        if (specular) engine.destroy(specular);
    }
};

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

Environment::Environment(std::unique_ptr<Impl> impl) : mImpl(std::move(impl)) {}
Environment::Environment(Environment&&) noexcept = default;
Environment& Environment::operator=(Environment&&) noexcept = default;
Environment::~Environment() = default;

IndirectLight Environment::indirectLight() const { return mImpl->indirectLight; }
Skybox Environment::skybox() const { return mImpl->skybox; }

Result<Environment> loadEnvironment(Engine& engine, std::filesystem::path const& path,
                                    EnvironmentLoadOptions const& options) {
    using Made = Result<std::unique_ptr<Environment::Impl>>;
    auto made = orOutOfMemory("environment", path.native(), [&]() -> Made {
        Engine::Impl& impl = engine.impl();
        auto data = assets::loadEnvironment(path, impl.jobs,
                                            { .cacheDirectory = impl.options.cacheDirectory,
                                              .faceSize = options.faceSize,
                                              .samples = options.samples,
                                              .format = options.format,
                                              .mapping = options.roughnessMapping,
                                              .progress = options.progress });
        if (!data) return data.error();

        const std::string name = path.filename().string();
        std::unique_ptr<Environment::Impl> parts(new Environment::Impl{ impl });
        parts->specular = uploadCube(impl, data->specular, name);
        parts->sky = uploadCube(impl, data->sky, name + " sky");
        parts->irradiance = uploadCube(impl, data->irradiance, name + " irradiance");
        parts->indirectLight = orBadAlloc(engine.create(IndirectLightDesc{ .specular = parts->specular,
                                                                           .specularLevels = data->specular.levels,
                                                                           .mapping = data->mapping,
                                                                           .irradiance = parts->irradiance,
                                                                           .irradianceSh = data->irradianceSh,
                                                                           .name = name }));
        parts->skybox = orBadAlloc(engine.create(SkyboxDesc{ .cube = parts->sky, .name = name }));
        impl.flush(); // the driver thread uploads while the caller continues
        return parts;
    });
    if (!made) return made.error();
    return Environment(std::move(*made));
}

} // namespace filament
