// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/gltf/GltfMaterials.h"

#include "base/Log.h"
#include "filament_core/engine/TextureStreamer.h"
#include "shaders/package/GroupLayouts.h"

namespace filament_core {
namespace {

// The engine's own packages have these parameters: a failure is a defect of GltfMaterialSettings.
void require(Result<void> const& result) {
    if (!result) log(Severity::Error, "{}", result.error().message);
    FILAMENT_ASSERT(result.ok(), "the glTF materials have the parameters that GltfMaterialSettings names");
}

/// A map only lowers the factor. Anisotropy makes one direction rougher, and averaged normals make all.
std::optional<uint32_t> roughnessBound(GltfMaterialSettings const& settings, shader::MaterialPackage const& package) {
    shader::Parameter const* factor = package.findParameter("roughnessFactor");
    const bool isRougher = std::ranges::any_of(settings.constants, [](MaterialConstant const& constant) {
        return (constant.name == "hasAnisotropy" || constant.name == "normalWidth") &&
               constant.value == MaterialConstant{ "", true }.value;
    });
    return factor && !isRougher ? std::optional(factor->offset) : std::nullopt;
}

} // namespace

GltfMaterialChoice GltfMaterials::choiceOf(Engine::Impl const& engine, bool sectionPlanes) {
    const uint32_t ofEngine = shader::samplerCount(shader::passGroupLayout(shader::PassKind::LitScreen));
    return { .package = engine.enginePackages(),
             .maxMaps = engine.stream->info().limits.maxTextureUnits - ofEngine, // a device has at least 16 in all
             .sectionPlanes = sectionPlanes };
}

Material GltfMaterials::materialFor(GltfMaterialSettings const& settings) {
    const std::string key = materialKey(settings);
    Material& shared = mMaterials[key];
    if (!shared) {
        const auto ready = mReady.find(key);
        FILAMENT_ASSERT(ready != mReady.end(), "readMaterials() unpacks what the primitives of a model are drawn with");
        mModel.materials.push_back({}); // reserve the entry before the object exists
        auto created = mEngine.addMaterial(std::move(ready->second));
        if (!created) log(Severity::Error, "{}", created.error().message);
        FILAMENT_ASSERT(created.ok(), "settingsOf() leaves out maps that do not fit");
        mReady.erase(ready);
        shared = mModel.materials.back() = *created;
        scene::Material& state = mEngine.materials.get(shared);
        state.roughnessBound = roughnessBound(settings, state.package);
    }
    return shared;
}

MaterialInstance GltfMaterials::instanceFor(assets::MaterialData const& material, GltfVertices const& vertices,
                                            float scale) {
    GltfMaterialSettings settings = settingsOf(material, vertices, scale, mMaxMaps);
    if (mHasSections) useSections(settings);
    for (std::string const& map : settings.leftOut) {
        log(Severity::Warning,
            "material '{}': its {} map is left out, because {} samples no more than {} textures a stage", material.name,
            map, mEngine.device.device, mEngine.stream->info().limits.maxTextureUnits);
    }
    const Material parent = materialFor(settings);
    // The entry before the object: without one nothing would destroy it.
    mModel.instances.push_back({});
    const MaterialInstance instance = mModel.instances.back() = mEngine.createInstance(parent, material.name);
    mEngine.instances.get(instance).raster.cullingDisabled = material.doubleSided;
    for (auto const& [name, value] : settings.parameters) require(mEngine.set(instance, name, value));
    for (GltfMap const& map : settings.maps) {
        require(mEngine.set(instance, map.stem + "Map", mTextures[map.texture.image], map.texture.sampler));
        if (map.texture.hasTransform) require(mEngine.set(instance, map.stem + "UvMatrix", map.texture.uvTransform));
        if (mEngine.streamer)
            mEngine.streamer->addMap(instance, map.stem + "Map",
                                     map.texture.hasTransform ? map.stem + "UvMatrix" : std::string(),
                                     mTextures[map.texture.image], map.texture.uvSet);
    }
    return instance;
}

} // namespace filament_core
