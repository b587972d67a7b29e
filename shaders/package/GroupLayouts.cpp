// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/GroupLayouts.h"

#include "shaders/interface/ShaderInterface.h"

namespace filament::shader {

PassKind passKind(MaterialDomain domain, ShadingModel shading) {
    if (domain == MaterialDomain::PostProcess) return PassKind::Picture;
    return shading == ShadingModel::Unlit ? PassKind::Unlit : PassKind::Lit;
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
    add(kBindingLights, BindingType::DynamicUniformBuffer, ShaderStage::Fragment);
    return layout;
}

backend::BindGroupLayout passGroupLayout(PassKind kind) {
    using backend::BindingType;
    using backend::ShaderStage;
    backend::BindGroupLayout layout;
    layout.bindings[layout.count++] = { .binding = kBindingPass, .type = BindingType::UniformBuffer };
    if (kind != PassKind::Lit) return layout;
    for (const PassBinding binding : { kBindingSpecular, kBindingDfg, kBindingIrradiance }) {
        layout.bindings[layout.count++] = { .binding = binding,
                                            .type = BindingType::SampledTexture,
                                            .stages = ShaderStage::Fragment };
    }
    return layout;
}

backend::BindGroupLayout deformationGroupLayout() {
    using backend::BindingType;
    using backend::ShaderStage;
    backend::BindGroupLayout layout;
    const auto add = [&](uint8_t binding, BindingType type) {
        layout.bindings[layout.count++] = { .binding = binding, .type = type, .stages = ShaderStage::Vertex };
    };
    add(kBindingBones, BindingType::DynamicUniformBuffer);
    add(kBindingMorph, BindingType::DynamicUniformBuffer);
    add(kBindingMorphDeltas, BindingType::SampledTexture);
    return layout;
}

backend::ProgramLayout programLayout(backend::ProgramLayout const& material, uint16_t variantKey) {
    backend::ProgramLayout layout = material;
    if ((variantKey & kVariantSkinning) != 0) layout[kGroupDeformation] = deformationGroupLayout();
    return layout;
}

} // namespace filament::shader
