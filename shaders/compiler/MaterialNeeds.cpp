// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/CodeScan.h"
#include "shaders/compiler/GlslDeclarations.h"
#include "shaders/compiler/GlslGenerator.h"
#include "shaders/compiler/StageText.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <span>

namespace filament_core::shader {
namespace {

/// The author's code with its includes, as input of CodeScan.
Result<std::string> expanded(std::optional<GlslBlock> const& block, IncludeResolver const& includes) {
    StageText text(includes);
    if (block) {
        if (Result<void> done = text.block(*block); !done) return done.error();
    }
    return std::move(text).take();
}

/// The words of #line are none of the author's.
std::string withoutFileNames(std::string text) {
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find('\n', at), text.size());
        if (std::string_view(text).substr(at).starts_with("#line "))
            std::fill(text.begin() + static_cast<std::ptrdiff_t>(at), text.begin() + static_cast<std::ptrdiff_t>(end),
                      ' ');
        at = end + 1;
    }
    return text;
}

using Declarations = std::span<const GlslDeclaration>;

/// A function that the engine calls.
struct Signature {
    std::string_view name, returns;
    std::initializer_list<std::string_view> parameters;
    std::string_view text; ///< as the guide shows it
};

/// Whether it exists with these parameters; an overload with others may exist beside it.
Result<void> expectFunction(CodeScan const& code, Declarations declarations, GlslBlock const& block,
                            Signature const& wanted) {
    if (!code.mentions(wanted.name)) return errorAt(block.at, fmt::format("this block must define {}", wanted.text));
    GlslDeclaration const* other = nullptr;
    for (GlslDeclaration const& own : declarations) {
        if (own.name != wanted.name || own.kind != GlslDeclaration::Kind::Function) continue;
        if (own.type == wanted.returns && std::ranges::equal(own.parameters, wanted.parameters) && own.isDefinition)
            return {};
        other = &own;
    }
    if (!other) return {}; // a macro may make it, or an engine's file that the block includes
    return fail(ErrorCode::InvalidArgument, "{}:{}: {}() must be {}{}", other->file, other->line, wanted.name,
                other->isDefinition ? "" : "defined: ", wanted.text);
}

bool mentionsAny(CodeScan const& code, std::initializer_list<std::string_view> words) {
    return std::ranges::any_of(words, [&](std::string_view word) { return code.mentions(word); });
}

bool declares(Declarations declarations, std::string_view name) {
    return std::ranges::count(declarations, name, &GlslDeclaration::name) > 0;
}

/// Checked here, because the GLSL compiler's errors would not name the remedy.
Result<void> checkInstanceIndex(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                CodeScan const& fragment, CodeScan const& vertex) {
    constexpr std::string_view kGetter = "getInstanceIndex";
    if (definition.package.instanced) return {};
    const bool isInVertex = vertex.mentions(kGetter) && !declares(needs.vertexDeclarations, kGetter);
    const bool isInFragment = fragment.mentions(kGetter) && !declares(needs.fragmentDeclarations, kGetter);
    if (!isInVertex && !isInFragment) return {};
    return errorAt(isInVertex ? definition.vertex->at : definition.fragment.at,
                   "this block calls getInstanceIndex(); that needs the property instanced : true");
}

const Signature kPostProcess{
    "postProcess", "void", { "PostProcessInputs" }, "void postProcess(inout PostProcessInputs inputs)"
};
const Signature kMaterial{ "material", "void", { "MaterialInputs" }, "void material(inout MaterialInputs material)" };
const Signature kMaterialVertex{
    "materialVertex", "void", { "MaterialVertexInputs" }, "void materialVertex(inout MaterialVertexInputs material)"
};
const Signature kSurfaceShading{
    "surfaceShading",
    "vec3",
    { "MaterialInputs", "ShadingData", "LightData" },
    "vec3 surfaceShading(const MaterialInputs materialInputs, const ShadingData shadingData, "
    "const LightData lightData), as customSurfaceShading : true says"
};

Result<void> checkBlocks(MaterialDefinition const& definition, MaterialNeeds const& needs, CodeScan const& fragment,
                         CodeScan const& vertex) {
    const Declarations inFragment = needs.fragmentDeclarations;
    if (definition.package.domain == MaterialDomain::PostProcess)
        return expectFunction(fragment, inFragment, definition.fragment, kPostProcess);
    Result<void> done = expectFunction(fragment, inFragment, definition.fragment, kMaterial);
    if (done) done = checkInstanceIndex(definition, needs, fragment, vertex);
    if (done && definition.customSurfaceShading)
        done = expectFunction(fragment, inFragment, definition.fragment, kSurfaceShading);
    if (done && definition.vertex)
        done = expectFunction(vertex, needs.vertexDeclarations, *definition.vertex, kMaterialVertex);
    return done;
}

/// Vertex stages keep all of their textures.
Result<void> checkVertexTextures(MaterialDefinition const& definition, CodeScan const& vertex) {
    for (size_t i = 0; i < definition.package.parameters.size(); ++i) {
        Parameter const& parameter = definition.package.parameters[i];
        if (parameter.usedIf.empty() || !vertex.mentions("materialParams_" + parameter.name)) continue;
        return errorAt(definition.parameterSources[i].at,
                       fmt::format("'{}' has usedIf, so only the fragment block can read it", parameter.name));
    }
    return {};
}

Result<void> findNames(std::string_view fragment, std::string_view vertex, MaterialDefinition const& definition,
                       MaterialNeeds& needs) {
    needs.fragmentDeclarations = authorsDeclarations(fragment, definition.fileName);
    needs.vertexDeclarations = authorsDeclarations(vertex, definition.fileName);
    for (auto const* declarations : { &needs.vertexDeclarations, &needs.fragmentDeclarations }) {
        if (Result<void> free = checkNames(*declarations); !free) return free;
        addCollisions(*declarations, needs.prefixed);
    }
    return {};
}

uint8_t customsIn(MaterialDefinition const& definition, CodeScan const& fragment) {
    uint32_t read = 0;
    for (uint32_t i = 0; i < 8; ++i) {
        const bool isRequired = definition.needsAttribute(kAttributeCustom0 + i);
        if (isRequired && fragment.mentions(fmt::format("getCustom{}", i))) read |= 1u << i;
    }
    return static_cast<uint8_t>(read);
}

/// They are members of MaterialVertexInputs, beside what the engine keeps there.
Result<void> checkVariableNames(MaterialDefinition const& definition, MaterialNeeds const& needs) {
    const std::pair<std::string_view, bool> taken[] = {
        { "color", definition.needsAttribute(kAttributeColor) },
        { "uv0", definition.needsAttribute(kAttributeUv0) },
        { "uv1", definition.needsAttribute(kAttributeUv1) },
        { "worldNormal", needs.normal },
        { "clipSpaceTransform", needs.clipSpaceTransform },
        { "clipSpacePosition", needs.clipSpacePosition },
        { "worldPosition", true },
        { "lineWidth", definition.wideLines },
        { "lineEnd", definition.wideLines },
        { "pointPixels", definition.sizedPoints },
        { "pointMeters", definition.sizedPoints },
    };
    for (Variable const& variable : definition.variables) {
        for (auto const& [name, isTaken] : taken) {
            if (!isTaken || variable.name != name) continue;
            return errorAt(variable.at, fmt::format("MaterialVertexInputs of this material has a member '{}' already; "
                                                    "choose another name for the variable",
                                                    name));
        }
    }
    return {};
}

/// The custom attributes of the fragment block take the places that variables leave.
Result<void> checkCustoms(MaterialDefinition const& definition, MaterialNeeds const& needs) {
    const auto read = static_cast<size_t>(std::popcount(needs.fragmentCustoms));
    const size_t places = customLocations(definition, needs).size();
    if (read <= places) return {};
    return errorAt(definition.fragment.at,
                   fmt::format("this block reads {} custom attributes, and beside {} variables there is place for {}; "
                               "pack them into variables in a vertex block",
                               read, definition.variables.size(), places));
}

} // namespace

Result<MaterialNeeds> findNeeds(MaterialDefinition const& definition, IncludeResolver const& includes) {
    Result<std::string> fragmentText = expanded(definition.fragment, includes);
    if (!fragmentText) return fragmentText.error();
    Result<std::string> vertexText = expanded(definition.vertex, includes);
    if (!vertexText) return vertexText.error();
    const CodeScan fragment(withoutFileNames(*fragmentText)), vertex(withoutFileNames(*vertexText));
    MaterialNeeds needs;
    if (Result<void> free = findNames(*fragmentText, *vertexText, definition, needs); !free) return free.error();
    if (Result<void> complete = checkBlocks(definition, needs, fragment, vertex); !complete) return complete.error();

    const bool isLit = definition.package.shading != ShadingModel::Unlit;
    needs.worldPosition = isLit || definition.package.shadowMultiplier || definition.package.sectionPlanes ||
                          mentionsAny(fragment, { "getWorldPosition", "getUserWorldPosition", "getWorldViewVector",
                                                  "getWorldReflectedVector", "getNdotV" });
    needs.normal = isLit || definition.needsAttribute(kAttributeTangents);
    needs.tangent = needs.normal && fragment.mentions("getWorldTangentFrame");
    needs.clipSpaceTransform =
            definition.package.vertexDomain == VertexDomain::Device && vertex.mentions("clipSpaceTransform");
    needs.clipSpacePosition = vertex.mentions("clipSpacePosition");
    needs.bump = isLit && mentionsAny(fragment, { "applyBump", "gltfBump" }) &&
                 !declares(needs.fragmentDeclarations, "applyBump");
    needs.colors = mentionsAny(fragment, { "luminance", "inverseTonemap", "inverseTonemapSRGB", "ycbcrToRgb" });
    needs.instanceIndex = definition.package.instanced && fragment.mentions("getInstanceIndex");
    needs.vertexTextures = vertexText->find("materialParams_") != std::string::npos;
    needs.callsPrepare = fragment.mentions("prepareMaterial");
    needs.words = fragment.words();
    needs.words.insert(vertex.words().begin(), vertex.words().end());
    needs.fragmentCustoms = customsIn(definition, fragment);
    Result<void> done = checkVertexTextures(definition, vertex);
    if (done) done = checkCustoms(definition, needs);
    if (done) done = checkVariableNames(definition, needs);
    if (!done) return done.error();
    return needs;
}

} // namespace filament_core::shader
