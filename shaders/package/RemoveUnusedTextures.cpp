// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/RemoveUnusedTextures.h"

#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/GroupLayouts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <utility>

namespace filament_core::shader {
namespace {

using backend::BindGroupLayout;
using backend::ConstantValue;
using backend::ProgramLayout;

// ---------------------------------------------------------------------------------------------- what is used

bool isTrue(MaterialPackage const& package, uint32_t id, std::span<const ConstantValue> given) {
    const auto value = std::ranges::find(given, id, &ConstantValue::id);
    if (value != given.end()) return value->bits != 0;
    const auto constant = std::ranges::find(package.constants, id, &Constant::id);
    return constant == package.constants.end() || constant->defaultBits != 0;
}

bool isUsed(MaterialPackage const& package, Parameter const& texture, std::span<const ConstantValue> given) {
    return texture.usedIf.empty() ||
           std::ranges::any_of(texture.usedIf, [&](uint32_t id) { return isTrue(package, id, given); });
}

/// Binding in the material group -> the binding that its variable gets.
using Moves = std::map<uint8_t, uint8_t>;

/// A remaining texture of the same kind that can stand in for this one; null if there is none.
Parameter const* standInFor(Parameter const& texture, std::vector<Parameter const*> const& staying) {
    const auto found = std::ranges::find_if(staying, [&](Parameter const* other) {
        return other->type == texture.type && other->format == texture.format && !other->currentPixel;
    });
    return found == staying.end() ? nullptr : *found;
}

/// Decides what is removed, and marks the parameters.
Moves takeOut(MaterialPackage& package, std::span<const ConstantValue> given) {
    std::vector<Parameter const*> staying;
    for (Parameter const& parameter : package.parameters) {
        if (isTexture(parameter.type) && isUsed(package, parameter, given)) staying.push_back(&parameter);
    }
    Moves moves;
    for (Parameter& parameter : package.parameters) {
        if (!isTexture(parameter.type) || isUsed(package, parameter, given)) continue;
        if (Parameter const* other = standInFor(parameter, staying)) {
            moves[parameter.binding] = other->binding;
            parameter.isBound = false;
        } else {
            staying.push_back(&parameter);
        }
    }
    return moves;
}

BindGroupLayout without(BindGroupLayout const& group, Moves const& moves) {
    BindGroupLayout left;
    for (uint32_t i = 0; i < group.count; ++i) {
        if (!moves.contains(group.bindings[i].binding)) left.bindings[left.count++] = group.bindings[i];
    }
    return left;
}

// ---------------------------------------------------------------------------------------------- SPIR-V

/// Calls `visit(words)` for each instruction before the first function; stops at malformed words.
void forEachDeclaration(std::span<uint32_t> module, auto&& visit) {
    constexpr size_t kHeaderWords = 5;
    constexpr uint32_t kOpFunction = 54; // SPIR-V specification 1.3, 3.32.9
    for (size_t at = kHeaderWords; at < module.size();) {
        const size_t count = module[at] >> 16;
        if (count == 0 || count > module.size() - at || (module[at] & 0xFFFF) == kOpFunction) return;
        visit(module.subspan(at, count));
        at += count;
    }
}

void moveInSpirv(std::span<uint32_t> module, Moves const& moves) {
    constexpr uint32_t kOpDecorate = 71, kBinding = 33, kDescriptorSet = 34; // ..., 3.32.3 and 3.20
    const auto isDecoration = [](std::span<uint32_t> words, uint32_t decoration) {
        return words.size() == 4 && (words[0] & 0xFFFF) == kOpDecorate && words[2] == decoration;
    };
    std::vector<uint32_t> inGroup;
    forEachDeclaration(module, [&](std::span<uint32_t> words) {
        if (isDecoration(words, kDescriptorSet) && words[3] == kGroupMaterial) inGroup.push_back(words[1]);
    });
    forEachDeclaration(module, [&](std::span<uint32_t> words) {
        if (!isDecoration(words, kBinding) || std::ranges::count(inGroup, words[1]) == 0) return;
        const auto move = moves.find(static_cast<uint8_t>(words[3]));
        if (move != moves.end()) words[3] = move->second;
    });
}

// ---------------------------------------------------------------------------------------------- ESSL

constexpr uint8_t kNoUnit = 0xFF;

/// Texture unit in the layout before -> the unit after.
std::array<uint8_t, 256> unitMoves(ProgramLayout const& before, ProgramLayout const& after, Moves const& moves) {
    std::array<uint8_t, 256> units;
    units.fill(kNoUnit);
    for (uint32_t group = 0; group < before.size(); ++group) {
        for (uint32_t i = 0; i < before[group].count; ++i) {
            if (before[group].bindings[i].type != backend::BindingType::SampledTexture) continue;
            const uint8_t binding = before[group].bindings[i].binding;
            const auto move = group == kGroupMaterial ? moves.find(binding) : moves.end();
            const uint8_t to = move == moves.end() ? binding : move->second;
            units[backend::flatBinding(before, group, binding)] = backend::flatBinding(after, group, to);
        }
    }
    return units;
}

/// Only samplers are declared with a number alone between the parentheses; blocks also state their layout.
std::string moveInEssl(std::string const& text, std::array<uint8_t, 256> const& units) {
    constexpr std::string_view kBefore = "layout(binding = ", kBehind = ") uniform ";
    std::string moved;
    moved.reserve(text.size());
    size_t done = 0;
    for (size_t at = text.find(kBefore); at != std::string::npos; at = text.find(kBefore, at + 1)) {
        const size_t number = at + kBefore.size();
        uint8_t unit = 0;
        const auto read = std::from_chars(text.data() + number, text.data() + text.size(), unit);
        const auto end = static_cast<size_t>(read.ptr - text.data());
        const bool isSampler = read.ec == std::errc{} && text.compare(end, kBehind.size(), kBehind) == 0;
        if (!isSampler || units[unit] == kNoUnit) continue;
        moved.append(text, done, number - done);
        moved += std::to_string(units[unit]);
        done = end;
    }
    return moved.append(text, done);
}

} // namespace

void removeUnusedTextures(MaterialPackage& package, std::span<const ConstantValue> constants) {
    const Moves moves = takeOut(package, constants);
    if (moves.empty()) return;
    MaterialPackage after{ .parameters = package.parameters, .layout = package.layout }; // the input of programLayout()
    after.layout[kGroupMaterial] = without(package.layout[kGroupMaterial], moves);
    // Variants that share a stage number what it reads alike.
    std::map<SharedStage, SharedStage> moved;
    const auto move = [&](SharedStage& stage, bool isFragment, std::array<uint8_t, 256> const& units) {
        SharedStage& known = moved[stage];
        if (!known) {
            StageCode code = *stage;
            if (isFragment) moveInSpirv(code.spirv, moves);
            code.essl = moveInEssl(code.essl, units); // a vertex stage may have textures of the Deformation group
            known = sharedStage(std::move(code));
        }
        stage = known;
    };
    for (Variant& variant : package.variants) {
        const auto units = unitMoves(programLayout(package, variant.key), programLayout(after, variant.key), moves);
        move(variant.vertex, false, units);
        move(variant.fragment, true, units);
    }
    package.layout = after.layout;
}

} // namespace filament_core::shader
