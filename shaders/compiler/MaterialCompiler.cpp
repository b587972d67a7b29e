// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/MaterialCompiler.h"

#include "jobsystem/JobSystem.h"
#include "shaders/compiler/EmbeddedSources.h"
#include "shaders/compiler/GlslGenerator.h"
#include "shaders/compiler/GlslSuggestions.h"
#include "shaders/compiler/MaterialAnalysis.h"
#include "shaders/compiler/MaterialMembers.h"
#include "shaders/compiler/Reflection.h"
#include "shaders/compiler/Variants.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace filament::shader {
namespace {

/// Everything that the variants share.
struct Prepared {
    MaterialDefinition definition;
    MaterialNeeds needs;
    backend::ProgramLayout layout{};
    IncludeResolver includes;
    std::vector<uint16_t> keys;
};

IncludeResolver withEngineFiles(IncludeResolver const& others) {
    return [others](std::string_view path) -> std::optional<std::string> {
        if (const auto own = embeddedSource(path)) return std::string(*own);
        return others ? others(path) : std::nullopt;
    };
}

Result<MaterialDefinition> define(std::string_view text, std::string_view fileName, IncludeResolver const& includes) {
    Result<MaterialText> parsed = parseMaterialText(text, fileName, includes);
    if (!parsed) return parsed.error();
    return defineMaterial(std::move(*parsed), fileName);
}

Result<Prepared> prepare(std::string_view text, std::string_view fileName, CompileOptions const& options) {
    Prepared prepared;
    prepared.includes = withEngineFiles(options.includes);
    Result<MaterialDefinition> definition = define(text, fileName, prepared.includes);
    if (!definition) return definition.error();
    prepared.definition = std::move(*definition);
    Result<MaterialNeeds> needs = findNeeds(prepared.definition, prepared.includes);
    if (!needs) return needs.error();
    prepared.needs = *needs;
    Result<void> terms = findTerms(prepared.definition, prepared.includes, prepared.needs);
    if (!terms) return withSuggestion(terms.error(), prepared.definition);
    prepared.layout = materialLayout(prepared.definition);
    MaterialPackage& package = prepared.definition.package;
    package.filteredVariants |= options.filteredVariants;
    prepared.keys = variantKeys(selectableBits(package.domain, package.shading, prepared.definition.halfPrecision),
                                package.filteredVariants);
    return prepared;
}

struct StagePair {
    std::string vertex, fragment;
};

Result<StagePair> generate(Prepared const& prepared, uint16_t key) {
    Result<std::string> vertex = generateVertex(prepared.definition, prepared.needs, prepared.includes);
    if (!vertex) return vertex.error();
    Result<std::string> fragment = generateFragment(prepared.definition, prepared.needs, key, prepared.includes);
    if (!fragment) return fragment.error();
    return StagePair{ std::move(*vertex), std::move(*fragment) };
}

struct CompiledVariant {
    Variant variant;
    uint32_t vertexInputs = 0;
};

Result<CompiledVariant> compileVariant(Prepared const& prepared, uint16_t key, CompileOptions const& options) {
    Result<StagePair> stages = generate(prepared, key);
    if (!stages) return stages.error();
    Result<ProgramShaders> shaders = compileProgram(stages->vertex, stages->fragment,
                                                    { .exact = options.exact,
                                                      .halfFragment = (key & kVariantHalf) != 0,
                                                      .optimization = options.optimization,
                                                      .spirv = options.spirv,
                                                      .essl = options.essl,
                                                      .layout = prepared.layout,
                                                      .vertexName = prepared.definition.fileName,
                                                      .fragmentName = prepared.definition.fileName });
    if (!shaders) return shaders.error();
    CompiledVariant compiled{ .vertexInputs = shaders->vertexInputs };
    compiled.variant = { .key = key,
                         .vertexSpirv = std::move(shaders->vertexSpirv),
                         .fragmentSpirv = std::move(shaders->fragmentSpirv),
                         .vertexEssl = std::move(shaders->vertexEssl),
                         .fragmentEssl = std::move(shaders->fragmentEssl) };
    return compiled;
}

using Compiled = std::vector<std::optional<Result<CompiledVariant>>>;

Compiled compileVariants(Prepared const& prepared, CompileOptions const& options) {
    Compiled results(prepared.keys.size());
    const auto compileRange = [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) results[i] = compileVariant(prepared, prepared.keys[i], options);
    };
    if (options.jobs)
        jobs::parallelFor<"compile variant">(*options.jobs, results.size(), 1, compileRange);
    else
        compileRange(0, results.size());
    return results;
}

} // namespace

Result<MaterialPackage> compileMaterial(std::string_view text, std::string_view fileName,
                                        CompileOptions const& options) {
    Result<Prepared> prepared = prepare(text, fileName, options);
    if (!prepared) return prepared.error();
    Compiled variants = compileVariants(*prepared, options);

    MaterialPackage package = prepared->definition.package;
    package.layout = prepared->layout;
    const auto members = materialMembers();
    for (size_t i = 0; i < members.size(); ++i) {
        if ((prepared->needs.terms & termBit(i)) != 0) package.terms.emplace_back(members[i].name);
    }
    for (std::optional<Result<CompiledVariant>>& compiled :
         variants) { // the error of the lowest key, whoever was first
        Result<CompiledVariant>& result = *compiled;
        if (!result) return withSuggestion(result.error(), prepared->definition);
        package.requiredAttributes |= result->vertexInputs;
        package.variants.push_back(std::move(result->variant));
    }
    package.requiredAttributes &= ~(1u << kAttributeInstance); // comes from the engine, not from the geometry
    return package;
}

Result<std::string> describeTerms(std::string_view text, std::string_view fileName, CompileOptions const& options) {
    const Result<Prepared> prepared = prepare(text, fileName, options);
    if (!prepared) return prepared.error();
    std::string names;
    const auto members = materialMembers();
    for (size_t i = 0; i < members.size(); ++i) {
        if ((prepared->needs.terms & termBit(i)) == 0) continue;
        names += (names.empty() ? "" : " ") + std::string(members[i].term);
    }
    return names.empty() ? "no terms" : names;
}

Result<std::string> reflectParameters(std::string_view text, std::string_view fileName, CompileOptions const& options) {
    const Result<MaterialDefinition> definition = define(text, fileName, withEngineFiles(options.includes));
    if (!definition) return definition.error();
    return parametersAsJson(*definition);
}

Result<std::string> preprocessMaterial(std::string_view text, std::string_view fileName,
                                       CompileOptions const& options) {
    Result<Prepared> prepared = prepare(text, fileName, options);
    if (!prepared) return prepared.error();
    std::string out;
    for (const uint16_t key : prepared->keys) {
        Result<StagePair> stages = generate(*prepared, key);
        if (!stages) return stages.error();
        out += fmt::format("// ==== variant {} vertex\n{}\n// ==== variant {} fragment\n{}\n", key, stages->vertex, key,
                           stages->fragment);
    }
    return out;
}

} // namespace filament::shader
