// SPDX-License-Identifier: Apache-2.0
/// Materials and instances as the frame sees them: which code, which parameters, which raster state.
///   Thread  written by the app thread between frames, read by workers during prepare.
///   Life    instances point to their material; renderables point to their instance. Both have stable addresses.
#pragma once

#include "backend/api/Handles.h"
#include "shaders/package/Package.h"

#include <filament_core/Material.h>
#include <filament_core/Quality.h>
#include <filament_core/Sampler.h>
#include <filament_core/Stencil.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::scene {

struct Material {
    uint32_t id = 0; ///< small and dense: part of the sort key
    std::string name;
    shader::MaterialPackage package;
    std::vector<backend::ConstantValue> constants;
    uint32_t instanceCount = 0;
    uint32_t optionalAttributes = 0; ///< of package.requiredAttributes: read only if constants enable it
    MaterialDescription description;
    std::vector<std::byte> initialParameters; ///< of instances; empty: zeros
    /// Where an instance's parameters hold a float that its roughness does not exceed anywhere; none: not known.
    std::optional<uint32_t> roughnessBound{};

    /// Lights and shading do not affect the others.
    bool isLit() const { return package.shading != shader::ShadingModel::Unlit; }
    bool isBlended() const {
        return package.blending != shader::Blending::Opaque && package.blending != shader::Blending::Masked;
    }
    bool hasTwoPasses() const { return package.transparency != shader::TransparencyMode::Default && isBlended(); }
};

/// The part of the raster state that an instance can change.
struct InstanceRaster {
    shader::Culling culling = shader::Culling::Back;
    bool cullingDisabled = false; ///< both faces, whatever `culling` says
    bool colorWrite = true, depthWrite = true, depthCulling = true;
    std::optional<shader::Culling> shadowCulling{}; ///< in shadow maps; none: as everywhere
    std::optional<StencilState> stencil{};
    friend bool operator==(InstanceRaster const&, InstanceRaster const&) = default;
};

/// The same in shadow maps.
inline InstanceRaster inShadowMaps(InstanceRaster raster) {
    if (!raster.shadowCulling) return raster;
    raster.culling = *raster.shadowCulling;
    raster.cullingDisabled = false;
    return raster;
}

/// As the material defines it.
inline InstanceRaster initialRaster(shader::MaterialPackage const& package) {
    return { package.culling, package.doubleSided, package.colorWrite, package.depthWrite, package.depthCulling };
}

inline constexpr size_t kTextureFilters = 4; ///< enumerators of TextureFilter

struct TextureBinding {
    backend::TextureHandle texture;
    Sampler sampler{}; ///< as set by the user
};

struct MaterialInstance {
    uint32_t id = 0; ///< small and dense: part of the sort key
    Material* material = nullptr;
    std::string name;
    std::vector<std::byte> parameters;    ///< the MaterialParams block, std140
    std::vector<TextureBinding> textures; ///< parallel to the package's texture parameters, in their order
    InstanceRaster raster{};
    bool parametersDirty = true;
    bool texturesDirty = true;    ///< all groups have to be recreated
    bool lacksGroups = false;     ///< for a filter that came into use after the others
    backend::BufferHandle buffer; ///< none while the material has no block
    /// By TextureFilter, those in use: bind groups name their samplers. Without textures all are the same group.
    std::array<backend::BindGroupHandle, kTextureFilters> groups{};

    bool isDirty() const { return parametersDirty || texturesDirty || lacksGroups; }
    backend::BindGroupHandle group(TextureFilter filter) const { return groups[static_cast<size_t>(filter)]; }
};

} // namespace filament_core::scene
