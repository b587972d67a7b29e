// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/ViewLayout.h"

#include "shaders/interface/ShaderInterface.h"

namespace filament::shader {

backend::BindGroupLayout viewGroupLayout(MaterialDomain domain) {
    using backend::BindingType;
    using backend::ShaderStage;
    backend::BindGroupLayout layout;
    const auto add = [&](uint8_t binding, BindingType type, ShaderStage stages) {
        layout.bindings[layout.count++] = { .binding = binding, .type = type, .stages = stages };
    };
    add(kBindingFrame, BindingType::DynamicUniformBuffer, ShaderStage::Both);
    if (domain == MaterialDomain::PostProcess) return layout;
    add(kBindingObjects, BindingType::DynamicUniformBuffer, ShaderStage::Both);
    add(kBindingLights, BindingType::DynamicUniformBuffer, ShaderStage::Fragment);
    add(kBindingSpecular, BindingType::SampledTexture, ShaderStage::Fragment);
    add(kBindingDfg, BindingType::SampledTexture, ShaderStage::Fragment);
    add(kBindingSky, BindingType::SampledTexture, ShaderStage::Fragment);
    add(kBindingIrradiance, BindingType::SampledTexture, ShaderStage::Fragment);
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
