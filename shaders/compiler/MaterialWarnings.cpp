// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/MaterialWarnings.h"

#include "shaders/compiler/CodeScan.h"
#include "shaders/compiler/GlslToSpirv.h"
#include "shaders/compiler/SpirvWords.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace filament_core::shader {
namespace {

bool isHidden(Parameter const& parameter) {
    return parameter.name == kMaskThresholdParameter || parameter.name == kDoubleSidedParameter;
}

/// Textures have a name of their own in the code, others the name of a member, which is taken for read wherever the
/// word stands: this warns rather too little.
void addUnusedParameters(MaterialDefinition const& definition, MaterialNeeds const& needs,
                         std::vector<std::string>& out) {
    for (size_t i = 0; i < definition.package.parameters.size(); ++i) {
        Parameter const& parameter = definition.package.parameters[i];
        const bool isSampler = isTexture(parameter.type);
        const std::string word = (isSampler ? "materialParams_" : "") + parameter.name;
        if (isHidden(parameter) || needs.words.contains(word)) continue;
        out.push_back(errorAt(definition.parameterSources[i].at,
                              fmt::format("no code reads the parameter '{}'; leave it out", parameter.name))
                              .message);
    }
}

void addMissingPreparation(MaterialDefinition const& definition, MaterialNeeds const& needs,
                           std::vector<std::string>& out) {
    if (needs.callsPrepare || definition.package.domain == MaterialDomain::PostProcess) return;
    SourcePosition at = definition.fragment.at;
    const auto own = std::ranges::find(needs.fragmentDeclarations, "material", &GlslDeclaration::name);
    if (own != needs.fragmentDeclarations.end()) at = { std::make_shared<const std::string>(own->file), own->line };
    out.push_back(errorAt(at,
                          "material() does not call prepareMaterial(material), so normals and reflections are known "
                          "only after it; call it behind what sets material.normal")
                          .message);
}

/// Finds the first instruction in the author's text that uses a constant which is not a number.
class NanSearch {
public:
    std::optional<std::string> run(std::span<const uint32_t> module) {
        forEachInstruction(module, [&](spv::Op op, std::span<const uint32_t> words) { visit(op, words); });
        return mFound;
    }

private:
    void visit(spv::Op op, std::span<const uint32_t> words) {
        if (op == spv::OpString) mStrings[words[1]] = reinterpret_cast<const char*>(&words[2]);
        if (op == spv::OpTypeFloat) mFloats.insert(words[1]);
        if (op == spv::OpConstant && mFloats.contains(words[1]) && std::isnan(std::bit_cast<float>(words[3])))
            mNans.insert(words[2]);
        const bool isNan = std::ranges::any_of(words.subspan(1), [&](uint32_t id) { return mNans.contains(id); });
        if (op == spv::OpConstantComposite && isNan) mNans.insert(words[2]);
        if (op == spv::OpFunction) mIsInside = true;
        if (op == spv::OpLine) mFile = words[1], mLine = words[2];
        const bool isUse = mIsInside && op != spv::OpLine && op != spv::OpLabel && isNan;
        if (!isUse || mFound || isEngineFile(mStrings[mFile])) return;
        mFound = fmt::format("{}:{}: this is not a number: zero divided by zero, or a root or logarithm of a negative "
                             "number",
                             mStrings[mFile], mLine);
    }

    std::map<uint32_t, std::string> mStrings;
    std::set<uint32_t> mFloats, mNans;
    uint32_t mFile = 0, mLine = 0;
    bool mIsInside = false;
    std::optional<std::string> mFound;
};

void addNan(MaterialDefinition const& definition, MaterialNeeds const& needs, IncludeResolver const& includes,
            std::vector<std::string>& out) {
    const Result<std::string> text = generateObserver(definition, needs, includes);
    if (!text) return;
    const auto spirv = spirvFromGlsl(*text, backend::ShaderStage::Fragment, definition.fileName, true);
    if (!spirv) return;
    if (std::optional<std::string> found = NanSearch().run(*spirv)) out.push_back(std::move(*found));
}

} // namespace

std::vector<std::string> materialWarnings(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                          IncludeResolver const& includes) {
    std::vector<std::string> warnings = definition.warnings;
    addUnusedParameters(definition, needs, warnings);
    addMissingPreparation(definition, needs, warnings);
    addNan(definition, needs, includes, warnings);
    return warnings;
}

} // namespace filament_core::shader
