// SPDX-License-Identifier: Apache-2.0
/// GraphModel: the frame graph as boxes and arrows, from Renderer::graphviz() and Renderer::decisions().
///   In      the text that the engine writes; other text gives an empty graph, never an error.
///   Layout  passes in columns: each one right of everything that it reads (the longest path from a beginning), in the
///           order of the frame from top to bottom within a column. Sizes are in units of one box.
///   Arrows  from the pass that wrote a texture last to the one that reads or continues it, with the texture's name.
///   Thread  any; values.   Cost: proportional to the text.
#pragma once

#include <filament_core/Renderer.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

struct GraphBox {
    std::string name{};
    bool runs = true;
    uint32_t column = 0, row = 0;
    double milliseconds = 0; ///< 0: unknown
    uint64_t attachmentBytes = 0;
    std::string reason{};
};

struct GraphArrow {
    uint32_t from = 0, to = 0; ///< boxes; from < to
    std::string resource{};    ///< "color, 1280 x 720 RGBA16F"
};

struct FrameGraphModel {
    std::vector<GraphBox> boxes{}; ///< the passes, in the order of their declaration
    std::vector<GraphArrow> arrows{};
    uint32_t columns = 0, rows = 0;
};

FrameGraphModel graphOf(std::string_view graphviz, std::vector<EffectDecision> const& decisions);

} // namespace filament_core::view
