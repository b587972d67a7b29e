// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/MaterialAnalysis.h"

#include "shaders/compiler/GlslToSpirv.h"
#include "shaders/compiler/MaterialMembers.h"
#include "shaders/compiler/SpirvEditor.h"
#include "shaders/compiler/SpirvWords.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace filament_core::shader {
namespace {

/// The location of the first probed member among the probe's outputs, and that of its initial value among the inputs.
constexpr uint32_t kProbeOutputLocation = 1, kProbeInputLocation = 16;

bool isProbed(MaterialMember const& member, MaterialDefinition const& definition) {
    return member.absent != Absent::Never && member.isMemberOf(definition);
}

/// Indices into materialMembers(), ascending. A shader has fewer locations than there are members in all models.
std::vector<uint32_t> probedMembers(MaterialDefinition const& definition) {
    const auto members = materialMembers();
    std::vector<uint32_t> probed;
    for (uint32_t i = 0; i < members.size(); ++i) {
        if (isProbed(members[i], definition)) probed.push_back(i);
    }
    return probed;
}

/// A post-lighting colour is neutral if blending it changes nothing.
std::array<float, 4> neutralOf(MaterialMember const& member, MaterialDefinition const& definition) {
    if (member.name != "postLightingColor") return member.neutral;
    constexpr float kNone = std::numeric_limits<float>::infinity(); // equal to no constant
    switch (definition.package.postLightingBlending) {
    case PostLightingBlending::Opaque:
        return { kNone, kNone, kNone, kNone };
    case PostLightingBlending::Multiply:
        return { 1, 1, 1, 1 };
    case PostLightingBlending::Transparent:
    case PostLightingBlending::Add:
    case PostLightingBlending::Screen:
        return member.neutral;
    }
    return member.neutral;
}

bool isNeutral(std::span<const float> value, std::array<float, 4> const& neutral) {
    for (size_t i = 0; i < value.size(); ++i) {
        if (!std::isnan(neutral[i]) && value[i] != neutral[i]) return false;
    }
    return true;
}

/// If the initial value of a member is not neutral, the only question is whether the author's code sets it. Such
/// members come from an input, so that nothing folds with them.
bool comesFromOutside(MaterialMember const& member, MaterialDefinition const& definition) {
    const auto initial = std::span(member.initial).first(member.components);
    return member.absent == Absent::Untouched || !isNeutral(initial, neutralOf(member, definition));
}

// ---------------------------------------------------------------------------------------------- what the code stores

struct Arrival {
    enum class Kind : uint8_t { Nothing, Untouched, Constant, Computed };
    Kind kind = Kind::Nothing;
    std::vector<float> constant;
    friend bool operator==(Arrival const&, Arrival const&) = default;
};

/// The variables of the module that have a location, keyed by location.
struct Interface {
    std::unordered_map<SpirvId, uint32_t> inputs, outputs;
};

/// Decorations precede the variables.
Interface interfaceOf(SpirvWords module) {
    std::unordered_map<SpirvId, uint32_t> locations;
    Interface found;
    forEachInstruction(module, [&](spv::Op op, SpirvWords words) {
        if (op == spv::OpDecorate && words[2] == spv::DecorationLocation) locations[words[1]] = words[3];
        if (op != spv::OpVariable) return;
        const auto location = locations.find(words[2]);
        if (location == locations.end()) return;
        if (words[3] == spv::StorageClassInput) found.inputs.insert(*location);
        if (words[3] == spv::StorageClassOutput) found.outputs.insert(*location);
    });
    return found;
}

/// The first `count` probed members, in the order of probedMembers(). A member that receives different values from
/// several stores counts as computed.
std::vector<Arrival> arrivalsIn(SpirvWords module, size_t count) {
    const Interface interface = interfaceOf(module);
    std::vector<Arrival> arrivals(count);
    std::unordered_map<SpirvId, uint32_t> loaded; // value -> location of the input it was loaded from
    const SpirvEditor editor(module);
    const auto arrive = [&](size_t member, SpirvId value) {
        Arrival arrival{ Arrival::Kind::Computed, {} };
        const auto components = editor.constantOf(value);
        const auto source = loaded.find(value);
        if (!components.empty()) arrival = { Arrival::Kind::Constant, { components.begin(), components.end() } };
        if (source != loaded.end() && source->second == kProbeInputLocation + member)
            arrival = { Arrival::Kind::Untouched, {} };
        const bool isFirst = arrivals[member].kind == Arrival::Kind::Nothing;
        arrivals[member] = isFirst || arrivals[member] == arrival ? arrival : Arrival{ Arrival::Kind::Computed, {} };
    };
    forEachInstruction(module, [&](spv::Op op, SpirvWords words) {
        if (op == spv::OpLoad) {
            const auto input = interface.inputs.find(words[3]);
            if (input != interface.inputs.end()) loaded[words[2]] = input->second;
        }
        if (op == spv::OpStore) {
            const auto output = interface.outputs.find(words[1]);
            if (output != interface.outputs.end() && output->second >= kProbeOutputLocation)
                arrive(output->second - kProbeOutputLocation, words[2]);
        }
    });
    return arrivals;
}

// ---------------------------------------------------------------------------------------------- what it means

bool isTermIn(MaterialMember const& member, MaterialDefinition const& definition, Arrival const& arrival) {
    if (arrival.kind == Arrival::Kind::Untouched || arrival.kind == Arrival::Kind::Nothing) return false;
    if (member.absent == Absent::Untouched || arrival.kind != Arrival::Kind::Constant) return true;
    return !isNeutral(arrival.constant, neutralOf(member, definition));
}

} // namespace

// prepareMaterial() is the engine's; the probe wraps it to record what it is given.
void declareProbe(StageText& out, MaterialDefinition const& definition) {
    const auto members = materialMembers();
    std::string taken;
    const std::vector<uint32_t> probed = probedMembers(definition);
    for (uint32_t i = 0; i < probed.size(); ++i) {
        MaterialMember const& member = members[probed[i]];
        const std::string_view type = floatType(member.components);
        out.line(fmt::format("layout(location = {}) out {} probe_{};", kProbeOutputLocation + i, type, i));
        if (comesFromOutside(member, definition))
            out.line(fmt::format("layout(location = {}) in {} probe_initial_{};", kProbeInputLocation + i, type, i));
        if (member.isPrepared) taken += fmt::format("probe_{} = material.{}; ", i, member.name);
    }
    out.line(fmt::format("void probe_prepareMaterial(const MaterialInputs material) {{ {}prepareMaterial(material); }}",
                         taken));
    out.define("prepareMaterial", "probe_prepareMaterial");
}

void defineProbeMain(StageText& out, MaterialDefinition const& definition) {
    const auto members = materialMembers();
    std::string begin, end;
    const std::vector<uint32_t> probed = probedMembers(definition);
    for (uint32_t i = 0; i < probed.size(); ++i) {
        MaterialMember const& member = members[probed[i]];
        if (comesFromOutside(member, definition))
            begin += fmt::format("probe_inputs.{} = probe_initial_{}; ", member.name, i);
        if (!member.isPrepared) end += fmt::format("probe_{} = probe_inputs.{}; ", i, member.name);
    }
    out.line("void main() { MaterialInputs probe_inputs; initMaterial(probe_inputs); computeShadingGeometry();");
    out.line(begin + "material(probe_inputs);");
    out.line("#if defined(PREPARE_AFTER_MATERIAL)\nprepareMaterial(probe_inputs);\n#endif");
    out.line(end + "}");
}

Result<void> findTerms(MaterialDefinition const& definition, IncludeResolver const& includes, MaterialNeeds& needs) {
    if (definition.package.domain == MaterialDomain::PostProcess) return {};
    Result<std::string> text = generateProbe(definition, needs, includes);
    if (!text) return text.error();
    Result<std::vector<uint32_t>> spirv = spirvFromGlsl(*text, backend::ShaderStage::Fragment, definition.fileName);
    if (spirv) spirv = optimizeSpirv(*spirv);
    if (!spirv) return spirv.error();
    const std::vector<uint32_t> probed = probedMembers(definition);
    const std::vector<Arrival> arrivals = arrivalsIn(*spirv, probed.size());
    for (size_t i = 0; i < probed.size(); ++i) {
        MaterialMember const& member = materialMembers()[probed[i]];
        if (needs.bump && member.term == "HAS_NORMAL") needs.terms |= termBit(probed[i]); // applyBump() sets it
        if (!isTermIn(member, definition, arrivals[i])) continue;
        needs.terms |= termBit(probed[i]);
        needs.tangent |= member.isTangential;
    }
    needs.worldPosition |= needs.has("HAS_PIXEL_DEPTH_OFFSET");
    return {};
}

} // namespace filament_core::shader
