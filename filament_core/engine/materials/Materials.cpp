// SPDX-License-Identifier: Apache-2.0
// Materials of the app and of the engine.
#include "base/Log.h"
#include "base/OutOfMemory.h"
#include "base/Result.h"
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/materials/ConstantBits.h"
#include "filament_core/engine/materials/LoadMaterial.h"
#include "filament_core/passes/FullScreenPass.h"
#include "shaders/package/EngineMaterials.h"

#include <utility>

namespace filament_core {

using engine::PublicCall;

Result<Material> Engine::Impl::createMaterial(MaterialDesc const& desc) {
    auto loaded = engine::loadMaterial(desc);
    if (!loaded) return loaded.error();
    return addMaterial(std::move(*loaded));
}

Result<Material> Engine::Impl::addMaterial(scene::Material loaded) {
    const bool isFlat = loaded.package.interpolation == shader::Interpolation::Flat;
    if (isFlat && !stream->info().features.lastVertexProvokes) {
        return fail(ErrorCode::Unsupported,
                    "material '{}': interpolation : flat uses the last vertex of a triangle, but {} supports only the "
                    "first (it lacks VK_EXT_provoking_vertex); use interpolation : smooth",
                    loaded.name, device.device);
    }
    const Result<void> fits = engine::checkSamplers(loaded, stream->info().limits.maxTextureUnits, device.device);
    if (!fits) return fits.error();
    const uint32_t id = loaded.id = materialNumbers.take();
    try {
        return materials.add(std::move(loaded));
    } catch (...) {
        materialNumbers.giveBack(id);
        throw;
    }
}

void Engine::Impl::removeMaterial(Material material) noexcept {
    materialNumbers.giveBack(materials.get(material).id); // every cache has forgotten it
    materials.remove(material);
}

std::function<std::span<const std::byte>(std::string_view)> Engine::Impl::enginePackages() const {
    return options.exactShaders ? &shader::engineMaterial : options.debug.plainMaterials;
}

Material Engine::Impl::engineMaterial(std::string_view package, std::vector<MaterialConstant> constants) {
    std::string key(package);
    for (MaterialConstant const& constant : constants) key += '/' + std::to_string(engine::bitsOf(constant.value));
    if (const auto found = engineMaterials.find(key); found != engineMaterials.end()) return found->second;
    auto material = createMaterial({ enginePackage(package), std::move(constants), key });
    FILAMENT_ASSERT(material.ok(), "the engine's own materials are well formed");
    try {
        engineMaterials.emplace(key, *material);
    } catch (...) {
        removeMaterial(*material);
        throw;
    }
    return *material;
}

scene::MaterialInstance const* Engine::Impl::motionInstance() {
    if (!drawingMotion) drawingMotion = createInstance(engineMaterial("motion", {}), "motion");
    return &instances.get(drawingMotion);
}

scene::MaterialInstance const* Engine::Impl::levelFadeInstance(bool hasBothSides) {
    MaterialInstance& known = fadingLevels[hasBothSides];
    if (!known) {
        known = createInstance(engineMaterial("level_fade", {}), "level fade");
        instances.get(known).raster.cullingDisabled = hasBothSides;
    }
    return &instances.get(known);
}

scene::MaterialInstance const* Engine::Impl::debugDrawInstance(bool isTested) {
    MaterialInstance& known = drawingDebug[isTested];
    if (!known) {
        known = createInstance(engineMaterial("debug_draw", {}), "debug draw");
        instances.get(known).raster.depthCulling = isTested;
    }
    return &instances.get(known);
}

MaterialInstance Engine::Impl::splatInstance() {
    if (!drawingSplats) drawingSplats = createInstance(engineMaterial("splats", {}), "splats");
    return drawingSplats;
}

scene::Material const& Engine::Impl::fullScreenMaterial(std::string_view package,
                                                        std::vector<MaterialConstant> constants,
                                                        passes::FullScreenInterface const& given) {
    scene::Material const& material = materials.get(engineMaterial(package, std::move(constants)));
    const Result<void> fits = passes::checkFullScreenMaterial(material, given);
    if (!fits) log(Severity::Error, "{}", fits.error().message);
    FILAMENT_ASSERT(fits.ok(), "a full-screen pass gives the engine's material what it reads");
    return material;
}

Result<Material> Engine::create(MaterialDesc const& desc) {
    const PublicCall call(mImpl, "Engine::create(MaterialDesc)", desc.name);
    return orOutOfMemory("material", desc.name, [&] { return mImpl->createMaterial(desc); });
}

MaterialDescription const& Engine::describe(Material material) const {
    const PublicCall call(mImpl, "Engine::describe(Material)");
    return mImpl->materials.get(material).description;
}

} // namespace filament_core
