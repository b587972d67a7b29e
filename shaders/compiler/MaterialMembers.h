// SPDX-License-Identifier: Apache-2.0
/// MaterialMembers: the members of MaterialInputs (materials guide, 4.4.2), one row each: which materials have it, its
/// initial value, when it costs nothing, and the term it adds to the shader otherwise.
///   The rows are the only source: the struct, initMaterial() and the analysis of what a material sets
///   (MaterialAnalysis.h) are derived from them.
///   Thread  any; constant data.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"
#include "shaders/compiler/StageText.h"

#include <array>
#include <cstdint>
#include <span>

namespace filament_core::shader {

enum class Absent : uint8_t {
    Never,     ///< always read: no term
    Untouched, ///< the term is included as soon as the code writes the member
    Neutral,   ///< the term is included unless the member is always `neutral` after the code has run
};

struct MaterialMember {
    std::string_view name;
    std::string_view meaning; ///< one line with unit and range, for documents; never empty
    uint8_t components = 1;   ///< of a float vector
    std::array<float, 4> initial{};
    bool (*isMemberOf)(MaterialDefinition const&) = nullptr;
    Absent absent = Absent::Never;
    std::string_view term;          ///< the macro that the texts test; empty: none
    std::array<float, 4> neutral{}; ///< NaN: any value
    bool isPrepared = false;        ///< prepareMaterial() reads it: later writes have no effect
    bool isTangential = isPrepared; ///< given in tangent space: needs tangents
};

std::span<const MaterialMember> materialMembers();

/// Index into materialMembers() -> its bit in MaterialNeeds::terms.
constexpr uint64_t termBit(size_t member) { return uint64_t{ 1 } << member; }

/// What an output of that many components holds unless the code sets it: 0, and alpha 1.
std::string initialOutput(uint32_t components);

/// struct MaterialInputs and initMaterial(); the outputs of a surface are members, too.
void declareMaterialInputs(StageText& out, MaterialDefinition const& definition);
/// A main() that hands the sum of all members, as material() leaves them, to the output.
void defineObserverMain(StageText& out, MaterialDefinition const& definition);
/// "float", "vec2", ...
std::string_view floatType(uint32_t components);
/// "vec2(0.5, 1.0)"
std::string floatLiteral(std::span<const float> components);

} // namespace filament_core::shader
