// SPDX-License-Identifier: Apache-2.0
/// ViewCase: a view, what it sees and what it is drawn to, made of one value of each factor of viewFactors().
///   Thread  any; plain values.   Fails: never.
#pragma once

#include "tests/filament_core/generated/AllPairs.h"

#include <filament_core/filament_core.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::test {

enum class SeenScene : uint8_t { Everything, Empty, SkyOnly, UnlitOnly, BlendedOnly };
enum class SeenTarget : uint8_t { Rgba8, Rgb10A2, HalfFloats, SrgbWithMips, LightWithDepth };

struct ViewCase {
    View view{};
    SeenScene scene = SeenScene::Everything;
    SeenTarget target = SeenTarget::Rgba8;
    std::optional<PassPlace> pass{}; ///< of a pass of the app that reads all inputs
    bool hasDirt = false, hasDebugDraw = false, hasProbe = false, moves = false;
    std::string words; ///< "size=1x1 samples=4 ...": its values, for messages
};

struct ViewValue {
    std::string_view name;
    void (*apply)(ViewCase&);
};
struct ViewFactor {
    std::string_view name;
    std::vector<ViewValue> values;
};

/// The first value of each factor switches its effect off.
std::span<const ViewFactor> viewFactors();
std::vector<uint32_t> valuesOfFactors();
ViewCase viewCase(PairRow const& row);

/// The size of what the case is drawn to: that of the view, and around a viewport a few pixels.
uint2 targetSize(ViewCase const& viewCase);

} // namespace filament_core::test
