// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/materials/LoadMaterial.h"

#include "base/Suggest.h"
#include "filament_core/engine/materials/CheckSpirv.h"
#include "filament_core/engine/materials/ConstantBits.h"
#include "filament_core/engine/materials/DescribeMaterial.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/EngineMaterials.h"
#include "shaders/package/GroupLayouts.h"
#include "shaders/package/RemoveUnusedTextures.h"

#include <utility>

namespace filament_core::engine {
namespace {

using backend::ConstantValue;

constexpr uint32_t bitOf(Attribute attribute) { return 1u << static_cast<uint32_t>(attribute); }

/// Constants of the glTF materials select which of these a mesh has.
constexpr uint32_t kOptionalInGltf =
        bitOf(Attribute::Color) | bitOf(Attribute::Uv0) | bitOf(Attribute::Uv1) | bitOf(Attribute::Custom0);

const char* typeName(ConstantValue::Type type) {
    switch (type) {
    case ConstantValue::Type::Bool:
        return "bool";
    case ConstantValue::Type::Int:
        return "int";
    case ConstantValue::Type::Float:
        return "float";
    }
    return "unknown";
}

Result<std::vector<ConstantValue>> resolveConstants(shader::MaterialPackage const& package,
                                                    std::vector<MaterialConstant> const& given) {
    std::vector<ConstantValue> values;
    for (MaterialConstant const& constant : given) {
        shader::Constant const* known = package.findConstant(constant.name);
        if (!known) {
            return fail(ErrorCode::NotFound, "material '{}' has no constant '{}'{}", package.name, constant.name,
                        suggestion(constant.name, namesOf(package.constants)));
        }
        if (known->type != typeOf(constant.value)) {
            return fail(ErrorCode::InvalidArgument, "constant '{}' of material '{}' is {}, but was given {}",
                        constant.name, package.name, typeName(known->type), typeName(typeOf(constant.value)));
        }
        values.push_back({ known->id, bitsOf(constant.value), known->type });
    }
    return values;
}

} // namespace

Result<shader::MaterialPackage> unpackMaterial(MaterialDesc const& desc) {
    auto package = shader::readPackage(desc.package);
    if (!package) {
        return fail(package.error().code, "material package '{}': {}", desc.name, package.error().message);
    }
    // Part of this program: only packages from elsewhere can be damaged.
    if (shader::isEnginePackage(desc.package)) return package;
    if (Result<void> checked = checkSpirv(*package); !checked) {
        return fail(checked.error().code, "material package '{}': {}", desc.name, checked.error().message);
    }
    return package;
}

Result<scene::Material> specialiseMaterial(shader::MaterialPackage package, MaterialDesc const& desc) {
    auto constants = resolveConstants(package, desc.constants);
    if (!constants) return constants.error();
    scene::Material material;
    material.name = desc.name.empty() ? package.name : desc.name;
    material.package = std::move(package);
    if (shader::isEnginePackage(desc.package) && material.package.name.starts_with("gltf_"))
        material.optionalAttributes = kOptionalInGltf;
    material.constants = std::move(*constants);
    // After the constants are known: they decide which textures are used.
    shader::removeUnusedTextures(material.package, material.constants);
    material.description = describeMaterial(material);
    return material;
}

Result<scene::Material> loadMaterial(MaterialDesc const& desc) {
    Result<shader::MaterialPackage> package = unpackMaterial(desc);
    if (!package) return package.error();
    return specialiseMaterial(std::move(*package), desc);
}

Result<void> checkSamplers(scene::Material const& material, uint32_t units, std::string_view device) {
    const uint32_t own = shader::samplerCount(material.package.layout[shader::kGroupMaterial]);
    const uint32_t engines = shader::samplerCount(material.package.layout[shader::kGroupPass]);
    if (own + engines <= units) return {};
    return fail(ErrorCode::Unsupported,
                "material '{}' samples {} textures, {} of them the engine's, and {} has {} a stage; leave some out, or "
                "load it with constants that switch them off (usedIf)",
                material.name, own + engines, engines, device, units);
}

} // namespace filament_core::engine
