// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/TextureConditions.h"

#include "shaders/compiler/GlslToSpirv.h"
#include "shaders/compiler/SpirvWords.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <set>

namespace filament_core::shader {
namespace {

/// The names of the constants, as in the author's list.
std::string namesOf(MaterialDefinition const& definition, Parameter const& texture) {
    std::string names;
    for (const uint32_t id : texture.usedIf) {
        const auto constant = std::ranges::find(definition.package.constants, id, &Constant::id);
        names += fmt::format("{}{}", names.empty() ? "" : " or ", constant->name);
    }
    return names;
}

Result<std::vector<uint32_t>> authorsCode(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                          IncludeResolver const& includes) {
    const Result<std::string> text = generateObserver(definition, needs, includes);
    if (!text) return text.error();
    return spirvFromGlsl(*text, backend::ShaderStage::Fragment, definition.fileName);
}

/// The variable at that binding of the material group; 0 if the module has none.
uint32_t variableAt(std::span<const uint32_t> module, uint32_t binding) {
    std::set<uint32_t> inGroup, atBinding;
    uint32_t found = 0;
    forEachInstruction(module, [&](spv::Op op, std::span<const uint32_t> words) {
        if (op != spv::OpDecorate) return;
        if (words[2] == spv::DecorationDescriptorSet && words[3] == kGroupMaterial) inGroup.insert(words[1]);
        if (words[2] == spv::DecorationBinding && words[3] == binding) atBinding.insert(words[1]);
    });
    for (const uint32_t variable : atBinding) {
        if (inGroup.contains(variable)) found = variable;
    }
    return found;
}

bool loads(std::span<const uint32_t> module, uint32_t binding) {
    const uint32_t variable = variableAt(module, binding);
    bool isLoaded = false;
    forEachInstruction(module, [&](spv::Op op, std::span<const uint32_t> words) {
        isLoaded = isLoaded || (variable != 0 && op == spv::OpLoad && words[3] == variable);
    });
    return isLoaded;
}

} // namespace

Result<void> checkTextureConditions(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                    IncludeResolver const& includes) {
    std::vector<Parameter> const& parameters = definition.package.parameters;
    const auto isConditional = [](Parameter const& parameter) { return !parameter.usedIf.empty(); };
    if (std::ranges::none_of(parameters, isConditional)) return {};
    const Result<std::vector<uint32_t>> code = authorsCode(definition, needs, includes);
    if (!code) return code.error();
    for (size_t i = 0; i < parameters.size(); ++i) {
        if (!isConditional(parameters[i])) continue;
        std::vector<backend::ConstantValue> allFalse;
        for (const uint32_t id : parameters[i].usedIf) allFalse.push_back({ .id = id });
        const Result<std::vector<uint32_t>> without = optimizeWith(*code, allFalse);
        if (!without) return without.error();
        if (!loads(*without, parameters[i].binding)) continue;
        return errorAt(definition.parameterSources[i].at,
                       fmt::format("'{}' is also read where {} is false; read it only inside of if "
                                   "(materialConstants_...) of a constant that its usedIf names",
                                   parameters[i].name, namesOf(definition, parameters[i])));
    }
    return {};
}

} // namespace filament_core::shader
