// SPDX-License-Identifier: Apache-2.0
/// Look: a colour table of another program, a .cube file (Adobe, "Cube LUT Specification" 1.0, and what DaVinci Resolve
/// adds to it), for DisplayTransform::look. An immutable value: views share it.
///   Meaning  sRGB display values in and out, after the tone mapper; any other output space is encoded from its result.
///   Limits   2 to 65536 entries of a 1D table, 2 to 128 a side of a 3D table; finite numbers within 1e10.
///   Memory   12 B an entry. Engines keep the tables that they bake of it, and the look with them.
///   Thread   any.
///   Errors   NotFound, Unreadable, Corrupt, Unsupported: one line with file, line and reason.
#pragma once

#include <filament_core/DisplayTransform.h>
#include <filament_core/Effects.h>
#include <filament_core/Math.h>
#include <filament_core/Result.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core {

struct Look {
    std::string title;
    bool isCube = true; ///< 3D: size^3 entries, red fastest. Otherwise one curve per component: size entries
    uint32_t size = 0;
    float3 domainMin{ 0 }, domainMax{ 1 }; ///< the inputs of the first and the last entry
    std::vector<float3> entries;
    /// A curve per component that colours pass before the cube, 2 to 65536 entries; empty: none. With one, domainMin
    /// and domainMax are the same in every component.
    std::vector<float3> shaper{};
    float3 shaperMin{ 0 }, shaperMax{ 1 }; ///< the inputs of its first and its last entry
    friend bool operator==(Look const&, Look const&) = default;
};

/// Applies a look to a colour: linear between the entries of a curve, tetrahedral in a cube; the nearest entry
/// outside of its domain, and for NaN.
float3 lookedUp(Look const& look, float3 color);

/// `name` identifies the text in errors.
Result<std::shared_ptr<const Look>> parseLook(std::string_view text, std::string_view name);
Result<std::shared_ptr<const Look>> loadLook(std::filesystem::path const& path);

/// As a .cube file.
std::string cubeText(Look const& look);
Result<void> saveLook(std::filesystem::path const& path, Look const& look);

/// The transform of a view from grading to display values, as a cube of `size` entries a side, [2, 128], for other
/// programs. Its inputs are linear Rec. 709 on the logarithm of ACEScct (S-2016-001, section 4.4), from 0 (0.0729) to
/// 222.9 (1). `display.look` is part of it.
Look bakeLook(DisplayTransform const& display, ColorGrading const& grading, uint32_t size);

} // namespace filament_core
