// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/GroupLayouts.h"

#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <span>

namespace filament_core::shader {
namespace {

void mergeInputs(MaterialPackage const& package, backend::BindGroupLayout& group) {
    uint8_t attachment = 0;
    for (Parameter const& parameter : package.parameters) {
        if (!parameter.currentPixel) continue;
        const auto bindings = std::span(group.bindings).first(group.count);
        const auto at = std::ranges::find(bindings, parameter.binding, &backend::BindingDesc::binding);
        if (at == bindings.end()) continue;
        at->type = backend::BindingType::InputAttachment;
        at->inputAttachment = attachment++;
    }
}

} // namespace

bool readsScreen(MaterialPackage const& package) {
    return package.refractionMode == RefractionMode::ScreenSpace || package.reflections == Reflections::ScreenSpace;
}

PassKind passKind(MaterialPackage const& package) {
    if (package.domain == MaterialDomain::PostProcess) return PassKind::Picture;
    if (package.shading == ShadingModel::Unlit) return PassKind::Unlit;
    return readsScreen(package) ? PassKind::LitScreen : PassKind::Lit;
}

backend::BindGroupLayout viewGroupLayout() {
    using backend::BindingType;
    using backend::ShaderStage;
    backend::BindGroupLayout layout;
    const auto add = [&](uint8_t binding, BindingType type, ShaderStage stages) {
        layout.bindings[layout.count++] = { .binding = binding, .type = type, .stages = stages };
    };
    add(kBindingFrame, BindingType::DynamicUniformBuffer, ShaderStage::Both);
    add(kBindingObjects, BindingType::DynamicUniformBuffer, ShaderStage::Both);
    add(kBindingLights, BindingType::StorageBuffer, ShaderStage::Fragment);
    add(kBindingFroxels, BindingType::StorageBuffer, ShaderStage::Fragment);
    return layout;
}

backend::BindGroupLayout passGroupLayout(PassKind kind) {
    using backend::BindingType;
    using backend::ShaderStage;
    backend::BindGroupLayout layout;
    const auto add = [&](uint8_t binding, BindingType type, ShaderStage stages) {
        layout.bindings[layout.count++] = { .binding = binding, .type = type, .stages = stages };
    };
    add(kBindingPass, BindingType::UniformBuffer, ShaderStage::Both);
    for (EngineTexture const& texture : kEngineTextures) {
        if (!isReadBy(texture, kind)) continue;
        add(texture.binding, BindingType::SampledTexture, ShaderStage::Fragment);
        if (texture.binding == kBindingShadowMaps)
            add(kBindingShadows, BindingType::UniformBuffer, ShaderStage::Fragment);
    }
    if (kind == PassKind::Picture) return layout;
    add(kBindingFogCells, BindingType::StorageBuffer, ShaderStage::Fragment);
    add(kBindingProbes, BindingType::UniformBuffer, ShaderStage::Fragment);
    return layout;
}

backend::ProgramLayout fogLightLayout() {
    using backend::BindingType;
    backend::ProgramLayout layout;
    const auto add = [&](uint32_t group, uint8_t binding, BindingType type) {
        backend::BindGroupLayout& of = layout[group];
        of.bindings[of.count++] = { .binding = binding, .type = type, .stages = backend::ShaderStage::Compute };
    };
    add(kGroupView, kBindingFrame, BindingType::DynamicUniformBuffer);
    add(kGroupView, kBindingLights, BindingType::StorageBuffer);
    add(kGroupView, kBindingFroxels, BindingType::StorageBuffer);
    add(kGroupPass, kBindingShadowMaps, BindingType::SampledTexture);
    add(kGroupPass, kBindingShadows, BindingType::UniformBuffer);
    add(kGroupMaterial, kBindingWrittenFogCells, BindingType::StorageBuffer);
    add(kGroupMaterial, kBindingFogHistory, BindingType::UniformBuffer);
    add(kGroupMaterial, kBindingLastFogLight, BindingType::StorageBuffer);
    add(kGroupMaterial, kBindingWrittenFogLight, BindingType::StorageBuffer);
    return layout;
}

uint32_t samplerCount(backend::BindGroupLayout const& group) {
    const auto isSampler = [](backend::BindingDesc const& binding) {
        return binding.type == backend::BindingType::SampledTexture && binding.stages != backend::ShaderStage::Vertex;
    };
    const auto bindings = std::span(group.bindings).first(group.count);
    return static_cast<uint32_t>(std::ranges::count_if(bindings, isSampler));
}

backend::BindGroupLayout deformationGroupLayout() {
    using backend::BindingType;
    using backend::ShaderStage;
    backend::BindGroupLayout layout;
    const auto add = [&](uint8_t binding, BindingType type) {
        layout.bindings[layout.count++] = { .binding = binding, .type = type, .stages = ShaderStage::Vertex };
    };
    add(kBindingBones, BindingType::SampledTexture);
    add(kBindingDeformation, BindingType::DynamicUniformBuffer);
    add(kBindingMorphDeltas, BindingType::SampledTexture);
    return layout;
}

backend::ProgramLayout programLayout(MaterialPackage const& package, uint16_t variantKey) {
    backend::ProgramLayout layout = package.layout;
    if ((variantKey & kVariantSkinning) != 0) layout[kGroupDeformation] = deformationGroupLayout();
    if ((variantKey & kVariantMerged) != 0) mergeInputs(package, layout[kGroupMaterial]);
    return layout;
}

} // namespace filament_core::shader
