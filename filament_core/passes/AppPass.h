// SPDX-License-Identifier: Apache-2.0
/// Passes of the app (View::postProcess): materials of the domain postprocess over the image of a frame, at named
/// places.
///   Reads   of the frame what their materials name (AppInput), and textures of the app.
///   Draws   another image, of the size of the one that they read. Depths and normals are made for the first pass that
///           reads them, and serve all others.
///   Skips   all of it without passes: the frame is then what it is without this file.
///   Thread  the app thread.   Fails: std::bad_alloc. engine/PostProcess.h has checked the materials.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"
#include "filament_core/passes/FullScreenPass.h"

#include <filament_core/PostProcess.h>

#include <array>
#include <optional>
#include <string_view>

namespace filament_core::passes {

/// What a pass may read of the frame, by the name of its parameter.
enum class AppInput : uint8_t { Color, Depth, Normals, History };
inline constexpr std::array<std::string_view, 4> kAppInputs{ "color", "depth", "normals", "history" };

struct AppPass {
    scene::Material const* material = nullptr;
    PassPlace place = PassPlace::BeforeToneMapping;
    std::string_view name;    ///< in the graph
    std::string_view history; ///< the name that its image is kept by; empty: it does not read its history
    std::span<const std::byte> parameters;
    std::span<const FullScreenInput> images; ///< textures of the app
    std::array<bool, kAppInputs.size()> reads{};

    bool has(AppInput input) const { return reads[static_cast<size_t>(input)]; }
};

bool hasAppPasses(FrameContext const& context, PassPlace place);
bool readsDepth(std::span<const AppPass> passes);

/// The passes of a place, over `color`. Returns the last one's image: `into`, if it is given.
framegraph::TextureId addAppPasses(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets,
                                   PassPlace place, framegraph::TextureId color, framegraph::TextureId into = {});

/// Pixel by pixel; `to` may have several samples a pixel, which then become the same, and their mean `resolve`.
void addCopyPass(framegraph::FrameGraph& graph, FrameContext const& context, framegraph::TextureId from,
                 framegraph::TextureId to, framegraph::TextureId resolve = {});

} // namespace filament_core::passes
