// SPDX-License-Identifier: Apache-2.0
// <filament_core/BuiltInMaterials.h>: packages of shaders/material/built_in, and the values that their instances start
// with.
#include "base/Assert.h"
#include "base/OutOfMemory.h"
#include "base/Result.h"
#include "base/Suggest.h"
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/materials/Parameters.h"

#include <filament_core/BuiltInMaterials.h>

#include <algorithm>
#include <array>
#include <string>

namespace filament_core {
namespace {

constexpr std::array kBuiltIn{
    BuiltInMaterial{ "lit", "metals and others under lights and environment, of one colour" },
    BuiltInMaterial{ "unlit", "one colour, whatever the light" },
    BuiltInMaterial{ "litTextured", "lit, with the colours of a texture" },
    BuiltInMaterial{ "unlitTextured", "the colours of a texture, whatever the light" },
    BuiltInMaterial{ "litVertexColors", "lit, with a colour for each vertex" },
    BuiltInMaterial{ "vertexColors", "a colour for each vertex, whatever the light" },
    BuiltInMaterial{ "shadowCatcher", "nothing but the shadows on it" },
    BuiltInMaterial{ "litShadowCatcher", "the shadows of all lights on it, and screen-space reflections" },
    BuiltInMaterial{ "wireframe", "lines of any width: makeWireframe(), makeLineQuads()" },
    BuiltInMaterial{ "points", "discs and squares of any size: makePointQuads()" },
};

/// The packages of kBuiltIn, in its order.
constexpr std::array<std::string_view, kBuiltIn.size()> kPackages{
    "built_in_lit",        "built_in_unlit",        "built_in_lit_textured",   "built_in_unlit_textured",
    "built_in_lit_colors", "built_in_unlit_colors", "built_in_shadow_catcher", "built_in_lit_shadow_catcher",
    "built_in_wireframe",  "built_in_points",
};

struct InitialValue {
    std::string_view parameter;
    ParameterValue value;
};

/// Of every built-in material that has the parameter; the others are 0.
const std::array kInitialValues{
    InitialValue{ "baseColor", float3(1) }, InitialValue{ "roughness", 0.5f }, InitialValue{ "reflectance", 0.5f },
    InitialValue{ "lineWidth", 1.0f },      InitialValue{ "depthBias", 4.0f }, InitialValue{ "strength", 0.6f },
    InitialValue{ "pointPixels", 4.0f },    InitialValue{ "disc", true },
};

void writeInitialValues(scene::Material& material) {
    std::vector<std::byte> values(material.package.uniformBytes);
    for (InitialValue const& initial : kInitialValues) {
        shader::Parameter const* parameter = material.package.findParameter(initial.parameter);
        if (!parameter) continue;
        const Result<void> written = engine::writeParameter(material, *parameter, initial.value, values);
        FILAMENT_ASSERT(written.ok(), "an initial value has the type of its parameter");
    }
    material.initialParameters = std::move(values);
}

Error unknownMaterial(std::string_view name) {
    std::string all;
    for (BuiltInMaterial const& material : kBuiltIn) all += (all.empty() ? "" : ", ") + std::string(material.name);
    return fail(ErrorCode::NotFound, "no built-in material '{}'{}; there are {}", name,
                suggestion(name, namesOf(kBuiltIn)), all);
}

} // namespace

std::span<const BuiltInMaterial> builtInMaterials() { return kBuiltIn; }

Result<Material> createBuiltInMaterial(Engine& engine, std::string_view name) {
    const engine::PublicCall call(engine, "createBuiltInMaterial(Engine, string_view)", name);
    const auto found = std::ranges::find(kBuiltIn, name, &BuiltInMaterial::name);
    if (found == kBuiltIn.end()) return unknownMaterial(name);
    return orOutOfMemory("material", name, [&]() -> Result<Material> {
        Engine::Impl& impl = engine.impl();
        const std::string_view package = kPackages[static_cast<size_t>(found - kBuiltIn.begin())];
        Result<Material> material =
                impl.createMaterial({ .package = impl.enginePackage(package), .name = std::string(name) });
        if (!material) return material;
        try {
            writeInitialValues(impl.materials.get(*material));
        } catch (...) {
            impl.removeMaterial(*material);
            throw;
        }
        return material;
    });
}

} // namespace filament_core
