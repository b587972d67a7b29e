// SPDX-License-Identifier: Apache-2.0
#include <filament/Environment.h>

#include "filament_core/assets/Environment.h"
#include "filament_core/engine/EngineImpl.h"

namespace filament {

struct Environment::Impl {
    Engine::Impl& engine;
    Texture specular, sky;
    IndirectLight indirectLight;
    Skybox skybox;

    ~Impl() {
        Engine& owner = Engine::of(engine);
        owner.destroy(skybox);
        owner.destroy(indirectLight);
        owner.destroy(sky);
        owner.destroy(specular);
    }
};

namespace {

Texture uploadCube(Engine& engine, assets::Image const& image, std::string name) {
    return engine.create(TextureDesc{ .kind = TextureKind::Cube,
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
    Engine::Impl& impl = engine.impl();
    auto data = assets::loadEnvironment(path, impl.jobs,
                                        { .cacheDirectory = impl.options.cacheDirectory,
                                          .faceSize = options.faceSize,
                                          .samples = options.samples,
                                          .format = options.format,
                                          .progress = options.progress });
    if (!data) return data.error();

    const std::string name = path.filename().string();
    const Texture specular = uploadCube(engine, data->specular, name);
    const Texture sky = uploadCube(engine, data->sky, name + " sky");
    const IndirectLight light = engine.create(IndirectLightDesc{ .specular = specular,
                                                                 .specularLevels = data->specular.levels,
                                                                 .irradianceSh = data->irradianceSh,
                                                                 .name = name });
    const Skybox skybox = engine.create(SkyboxDesc{ .cube = sky, .name = name });
    impl.flush(); // the driver thread uploads while the caller goes on
    return Environment(std::unique_ptr<Environment::Impl>(new Environment::Impl{ impl, specular, sky, light, skybox }));
}

} // namespace filament
