// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/gltf/GltfMaterials.h"

#include "base/Log.h"
#include "shaders/package/GroupLayouts.h"

namespace filament {
namespace {

std::string keyOf(GltfMaterialSettings const& settings) {
    std::string key = settings.package;
    for (MaterialConstant const& constant : settings.constants) {
        key += '|' + constant.name + '=';
        key += std::visit([](auto value) { return std::to_string(value); }, constant.value);
    }
    return key;
}

// The engine's own packages have these parameters: a failure is a defect of GltfMaterialSettings.
void require(Result<void> const& result) {
    if (!result) log(Severity::Error, "{}", result.error().message);
    FILAMENT_ASSERT(result.ok(), "the glTF materials have the parameters that GltfMaterialSettings names");
}

/// A map only lowers the factor. Anisotropy makes one direction rougher.
std::optional<uint32_t> roughnessBound(GltfMaterialSettings const& settings, shader::MaterialPackage const& package) {
    shader::Parameter const* factor = package.findParameter("roughnessFactor");
    const bool isAnisotropic = std::ranges::any_of(settings.constants, [](MaterialConstant const& constant) {
        return constant.name == "hasAnisotropy" && constant.value == MaterialConstant{ "", true }.value;
    });
    return factor && !isAnisotropic ? std::optional(factor->offset) : std::nullopt;
}

} // namespace

size_t GltfMaterials::maxMaps() const {
    const uint32_t ofEngine = shader::samplerCount(shader::passGroupLayout(shader::PassKind::LitScreen));
    return mEngine.stream->info().limits.maxTextureUnits - ofEngine; // a device has at least 16 in all
}

Material GltfMaterials::materialFor(GltfMaterialSettings const& settings) {
    Material& shared = mMaterials[keyOf(settings)];
    if (!shared) {
        mModel.materials.push_back({}); // reserve the entry before the object exists
        auto created = mEngine.createMaterial(
                { mEngine.enginePackage(settings.package), settings.constants, settings.package });
        if (!created) log(Severity::Error, "{}", created.error().message);
        FILAMENT_ASSERT(created.ok(), "the glTF materials have the constants that GltfMaterialSettings names");
        shared = mModel.materials.back() = *created;
        scene::Material& state = mEngine.materials.get(shared);
        state.roughnessBound = roughnessBound(settings, state.package);
    }
    return shared;
}

MaterialInstance GltfMaterials::instanceFor(assets::MaterialData const& material, bool hasVertexColor, float scale) {
    const GltfMaterialSettings settings = settingsOf(material, hasVertexColor, scale, maxMaps());
    for (std::string const& map : settings.leftOut) {
        log(Severity::Warning,
            "material '{}': its {} map is left out, because {} samples no more than {} textures a stage", material.name,
            map, mEngine.device.device, mEngine.stream->info().limits.maxTextureUnits);
    }
    const Material parent = materialFor(settings);
    mModel.instances.push_back({});
    const MaterialInstance instance = mModel.instances.back() = mEngine.createInstance(parent, material.name);
    mEngine.instances.get(instance).raster.cullingDisabled = material.doubleSided;
    for (auto const& [name, value] : settings.parameters) require(mEngine.set(instance, name, value));
    for (GltfMap const& map : settings.maps) {
        require(mEngine.set(instance, map.stem + "Map", mTextures[map.texture.image], map.texture.sampler));
        if (map.texture.hasTransform) require(mEngine.set(instance, map.stem + "UvMatrix", map.texture.uvTransform));
    }
    return instance;
}

} // namespace filament
