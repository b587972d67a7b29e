// SPDX-License-Identifier: Apache-2.0
/// ShareSteps: the frames whose differences are the shares of a picture (<filament_core/Shares.h>).
///   In      a view, and what to tell apart.
///   Out     steps, each with the terms before it; the last one is the view. drawShares() draws them in turn.
///   Thread  the app thread.
///   Fails   as renderShares().
#pragma once

#include "filament_core/engine/SceneImpl.h"

#include <filament_core/Shares.h>

#include <functional>

namespace filament_core::engine {

struct ShareStep {
    ShareTerm term;
    View view;
    std::vector<uint8_t> dark; ///< by record of a light; empty: none is
    bool darkEnvironment = false;
};

std::vector<ShareStep> shareSteps(Scene const& scene, View const& view, ShareOptions const& options);

/// Draws the steps, a renderer each, and gives each image to `take`.
Result<void> drawShares(Engine& engine, Scene const& scene, std::span<const ShareStep> steps, uint32_t frames,
                        std::function<void(Image&&)> const& take);

/// Four half floats of an RGBA16F image.
std::array<uint16_t, 4> halvesAt(Image const& image, size_t pixel);

/// By which `after` differs from `before`; where they have the same bits, by 0.
double4 shareOf(std::array<uint16_t, 4> const& before, std::array<uint16_t, 4> const& after);

} // namespace filament_core::engine
