// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/MaterialCompiler.h"

#include "jobsystem/JobSystem.h"
#include "shaders/compiler/EmbeddedSources.h"
#include "shaders/compiler/GlslGenerator.h"
#include "shaders/compiler/GlslSuggestions.h"
#include "shaders/compiler/GlslToSpirv.h"
#include "shaders/compiler/MaterialAnalysis.h"
#include "shaders/compiler/MaterialMembers.h"
#include "shaders/compiler/MaterialWarnings.h"
#include "shaders/compiler/Reflection.h"
#include "shaders/compiler/TextureConditions.h"
#include "shaders/compiler/Variants.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/GroupLayouts.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace filament_core::shader {
namespace {

/// Shared by all variants.
struct Prepared {
    MaterialDefinition definition;
    MaterialNeeds needs;
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

void defineMacros(CompileOptions const& options, MaterialDefinition& definition) {
    std::string defines;
    for (auto const& [name, value] : options.defines) defines += fmt::format("#define {} {}\n", name, value);
    definition.fragment.defines = defines;
    if (definition.vertex) definition.vertex->defines = defines;
}

/// The fragment block is compiled first; the vertex block may be wrong, too.
Error withVertexErrors(Error const& fragment, Prepared const& prepared) {
    MaterialDefinition const& definition = prepared.definition;
    const Error first = withSuggestion(fragment, definition);
    if (!definition.vertex) return first;
    const Result<std::string> text = generateVertex(definition, prepared.needs, 0, prepared.includes);
    if (!text) return first;
    const auto vertex = spirvFromGlsl(*text, backend::ShaderStage::Vertex, definition.fileName);
    if (vertex) return first;
    const Error both[] = { withSuggestion(vertex.error(), definition), first };
    return joined(both);
}

/// For shadow maps and the TAA history, which are kept while nothing changes their contents.
void describeInputs(Prepared& prepared) {
    MaterialPackage& package = prepared.definition.package;
    const bool placesDepth = prepared.definition.vertex && !prepared.definition.useDefaultDepthVariant;
    package.depthReadsParameters = placesDepth || fragmentsDecideDepth(prepared.definition, prepared.needs);
    static constexpr std::string_view kOfFrame[] = { "getTime",
                                                     "getUserTime",
                                                     "getUserTimeMod",
                                                     "getMaterialGlobal0",
                                                     "getMaterialGlobal1",
                                                     "getMaterialGlobal2",
                                                     "getMaterialGlobal3",
                                                     "frameUniforms" };
    package.readsFrame =
            std::ranges::any_of(kOfFrame, [&](std::string_view word) { return prepared.needs.words.contains(word); });
}

Result<Prepared> prepare(std::string_view text, std::string_view fileName, CompileOptions const& options) {
    Prepared prepared;
    prepared.includes = withEngineFiles(options.includes);
    Result<MaterialDefinition> definition = define(text, fileName, prepared.includes);
    if (!definition) return definition.error();
    usePlatformDefaults(options.platform, *definition);
    prepared.definition = std::move(*definition);
    defineMacros(options, prepared.definition);
    // From the text alone, before anything is compiled: the probe of findTerms() is generated with it.
    Result<MaterialNeeds> needs = findNeeds(prepared.definition, prepared.includes);
    if (!needs) return needs.error();
    prepared.needs = std::move(*needs);
    Result<void> terms = findTerms(prepared.definition, prepared.includes, prepared.needs);
    if (!terms) return withVertexErrors(terms.error(), prepared);
    // After findTerms(), which has shown that the code compiles.
    Result<void> conditions = checkTextureConditions(prepared.definition, prepared.needs, prepared.includes);
    if (!conditions) return withSuggestion(conditions.error(), prepared.definition);
    MaterialPackage& package = prepared.definition.package;
    package.layout = materialLayout(prepared.definition, prepared.needs);
    package.filteredVariants |= options.filteredVariants;
    describeInputs(prepared);
    prepared.keys = variantKeys(selectableBits(prepared.definition), package.filteredVariants);
    if (!options.onlyVariant) return prepared;
    if (std::ranges::count(prepared.keys, *options.onlyVariant) == 0)
        return fail(ErrorCode::InvalidArgument, "{}: the material has no variant {}", fileName, *options.onlyVariant);
    prepared.keys = { *options.onlyVariant };
    return prepared;
}

/// Variants whose stages have the same text share them: each stage is compiled once.
struct Stage {
    backend::ShaderStage stage = backend::ShaderStage::Vertex;
    uint16_t key = 0; ///< the bits that its text depends on
    std::optional<Result<StageShader>> compiled{};
    SharedStage code{}; ///< once nothing failed
};

std::vector<Stage> distinctStages(Prepared const& prepared, std::span<const uint16_t> keys) {
    std::vector<Stage> stages;
    const auto add = [&](backend::ShaderStage stage, uint16_t key) {
        const auto isSame = [&](Stage const& known) { return known.stage == stage && known.key == key; };
        if (std::ranges::none_of(stages, isSame)) stages.push_back({ stage, key });
    };
    for (const uint16_t key : keys) {
        for (const backend::ShaderStage stage : { backend::ShaderStage::Vertex, backend::ShaderStage::Fragment })
            add(stage, key & variantBits(prepared.definition, prepared.needs, stage));
    }
    return stages;
}

Stage& stageOf(std::vector<Stage>& stages, Prepared const& prepared, backend::ShaderStage stage, uint16_t key) {
    const auto bits = static_cast<uint16_t>(key & variantBits(prepared.definition, prepared.needs, stage));
    return *std::ranges::find_if(stages, [&](Stage const& known) { return known.stage == stage && known.key == bits; });
}

Result<std::string> generate(Prepared const& prepared, Stage const& stage) {
    return stage.stage == backend::ShaderStage::Vertex
                   ? generateVertex(prepared.definition, prepared.needs, stage.key, prepared.includes)
                   : generateFragment(prepared.definition, prepared.needs, stage.key, prepared.includes);
}

/// The uniforms of the View and Deformation groups have dynamic offsets.
std::vector<SetBinding> dynamicBuffers() {
    return { { kGroupView, kBindingFrame },
             { kGroupView, kBindingObjects },
             { kGroupDeformation, kBindingDeformation } };
}

Result<StageShader> compileOne(Prepared const& prepared, Stage const& stage, CompileOptions const& options) {
    Result<std::string> text = generate(prepared, stage);
    if (!text) return text.error();
    return compileStage(*text, stage.stage,
                        { .exact = options.exact,
                          .halfFragment = (stage.key & kVariantHalf) != 0,
                          .optimization = options.optimization,
                          .spirv = options.spirv,
                          .essl = options.essl,
                          .dynamicUniformBuffers = dynamicBuffers(),
                          .layout = programLayout(prepared.definition.package, stage.key),
                          .vertexName = prepared.definition.fileName,
                          .fragmentName = prepared.definition.fileName });
}

std::vector<Stage> compileStages(Prepared const& prepared, CompileOptions const& options) {
    std::vector<Stage> stages = distinctStages(prepared, prepared.keys);
    const auto compileRange = [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) stages[i].compiled = compileOne(prepared, stages[i], options);
    };
    if (options.jobs)
        jobs::parallelFor<"compile stage">(*options.jobs, stages.size(), 1, compileRange);
    else
        compileRange(0, stages.size());
    return stages;
}

} // namespace

Result<MaterialPackage> compileMaterial(std::string_view text, std::string_view fileName,
                                        CompileOptions const& options) {
    Result<Prepared> prepared = prepare(text, fileName, options);
    if (!prepared) return prepared.error();
    std::vector<Stage> stages = compileStages(*prepared, options);

    MaterialPackage package = prepared->definition.package;
    const auto members = materialMembers();
    for (size_t i = 0; i < members.size(); ++i) {
        if ((prepared->needs.terms & termBit(i)) != 0) package.terms.emplace_back(members[i].name);
    }
    // In the order of the stages, not of their jobs: the message is the same for any number of workers.
    std::vector<Error> errors;
    for (Stage const& stage : stages) {
        if (!*stage.compiled) errors.push_back(withSuggestion(stage.compiled->error(), prepared->definition));
    }
    if (!errors.empty()) return joined(errors);
    for (Stage& stage : stages) {
        StageShader& shader = **stage.compiled;
        stage.code = sharedStage({ std::move(shader.spirv), std::move(shader.essl) });
    }
    for (const uint16_t key : prepared->keys) {
        Stage const& vertex = stageOf(stages, *prepared, backend::ShaderStage::Vertex, key);
        Stage const& fragment = stageOf(stages, *prepared, backend::ShaderStage::Fragment, key);
        // Joints are none of them: only renderables with a skin have them.
        if ((key & kVariantSkinning) == 0) package.requiredAttributes |= (*vertex.compiled)->vertexInputs;
        package.variants.push_back({ key, vertex.code, fragment.code });
    }
    if (options.warnings)
        *options.warnings = materialWarnings(prepared->definition, prepared->needs, prepared->includes);
    package.requiredAttributes &= ~(1u << kAttributeInstance); // provided by the engine, not by the geometry
    return package;
}

Result<std::string> describeTerms(std::string_view text, std::string_view fileName, CompileOptions const& options) {
    const Result<Prepared> prepared = prepare(text, fileName, options);
    if (!prepared) return prepared.error();
    std::string names;
    const auto members = materialMembers();
    for (size_t i = 0; i < members.size(); ++i) {
        if ((prepared->needs.terms & termBit(i)) == 0) continue;
        names += fmt::format("{}{}", names.empty() ? "" : " ", members[i].term);
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
        for (const backend::ShaderStage stage : { backend::ShaderStage::Vertex, backend::ShaderStage::Fragment }) {
            std::vector<Stage> of = distinctStages(*prepared, { &key, 1 });
            Result<std::string> glsl = generate(*prepared, stageOf(of, *prepared, stage, key));
            if (!glsl) return glsl.error();
            out += fmt::format("// ==== variant {} {}\n{}\n", key,
                               stage == backend::ShaderStage::Vertex ? "vertex" : "fragment", *glsl);
        }
    }
    return out;
}

} // namespace filament_core::shader
