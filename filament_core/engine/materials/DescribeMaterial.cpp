// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/materials/DescribeMaterial.h"

#include "filament_core/engine/materials/ConstantBits.h"

#include <algorithm>

namespace filament_core::engine {
namespace {

ConstantDescription describe(shader::Constant const& constant, scene::Material const& material) {
    const auto given = std::ranges::find(material.constants, constant.id, &backend::ConstantValue::id);
    const uint32_t bits = given == material.constants.end() ? constant.defaultBits : given->bits;
    return { constant.name, dataOf(constant.type, constant.defaultBits), dataOf(constant.type, bits) };
}

/// The variants that depend on the scene; the precision is a matter of Quality.
VariantSet variantSet(uint32_t key) { return static_cast<VariantSet>(key) & VariantSet::All; }

} // namespace

MaterialDescription describeMaterial(scene::Material const& material) {
    shader::MaterialPackage const& package = material.package;
    MaterialDescription out{ .name = material.name,
                             .domain = package.domain,
                             .shading = package.shading,
                             .blending = package.blending,
                             .transparency = package.transparency,
                             .culling = package.culling,
                             .featureLevel = package.featureLevel,
                             .maskThreshold = package.maskThreshold,
                             .doubleSided = package.doubleSided,
                             .colorWrite = package.colorWrite,
                             .depthWrite = package.depthWrite,
                             .depthCulling = package.depthCulling,
                             .alphaToCoverage = package.alphaToCoverage,
                             .requiredAttributes = package.requiredAttributes,
                             .filtered = variantSet(package.filteredVariants),
                             .terms = package.terms };
    for (shader::Parameter const& parameter : package.parameters) {
        const bool isOwn =
                parameter.name == shader::kMaskThresholdParameter || parameter.name == shader::kDoubleSidedParameter;
        if (isOwn) continue; // a parameter of the compiler
        out.parameters.push_back(
                { parameter.name, parameter.type, parameter.arraySize, parameter.precision, parameter.format });
    }
    for (shader::Constant const& constant : package.constants) out.constants.push_back(describe(constant, material));
    constexpr uint16_t kOfPasses = shader::kVariantHalf | shader::kVariantMerged | shader::kVariantDepth |
                                   shader::kVariantMotion | shader::kVariantDebug;
    for (shader::Variant const& variant : package.variants) {
        const bool isOfScene = (variant.key & kOfPasses) == 0;
        if (isOfScene) out.variants.push_back(variantSet(variant.key));
    }
    return out;
}

} // namespace filament_core::engine
