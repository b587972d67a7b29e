// SPDX-License-Identifier: Apache-2.0
/// Subresources: a number for every level and layer of every texture of a graph, and for every buffer, so that the
/// steps of compile() can keep a value for each.
///   Memory  one number a texture, in the graph's arena.
///   Limits  accesses whose range leaves their texture must not get here: checkDeclarations() looks at that first.
///   Cost    constant for each level and layer of an access; most textures have one.
#pragma once

#include "framegraph/FrameGraph.h"

#include <cstdint>
#include <span>

namespace filament_core::framegraph {

class Subresources {
public:
    explicit Subresources(FrameGraph const& graph)
            : mGraph(graph), mFirst(graph.arena().array<uint32_t>(graph.textures().size())) {
        for (size_t i = 0; i < mFirst.size(); ++i) {
            mFirst[i] = mCount;
            mCount += uint32_t{ graph.textures()[i].desc.levels } * graph.textures()[i].desc.layers;
        }
    }

    uint32_t count() const { return mCount + static_cast<uint32_t>(mGraph.buffers().size()); }

    uint32_t of(BufferId buffer) const { return mCount + buffer.index(); }

    uint32_t of(TextureId texture, uint8_t level, uint16_t layer) const {
        return mFirst[texture.index()] + uint32_t{ level } * mGraph.texture(texture).desc.layers + layer;
    }

    /// visit(number, level, layer) for every one of the range, level by level, until it returns true; whether it did.
    template <class F>
    bool any(TextureId texture, backend::TextureRange const& range, F&& visit) const {
        for (uint32_t level = range.level; level < uint32_t{ range.level } + range.levelCount; ++level) {
            for (uint32_t layer = range.layer; layer < uint32_t{ range.layer } + range.layerCount; ++layer) {
                const auto at = static_cast<uint8_t>(level);
                const auto on = static_cast<uint16_t>(layer);
                if (visit(of(texture, at, on), at, on)) return true;
            }
        }
        return false;
    }

    /// visit(number) for every one of the range.
    template <class F>
    void forEach(TextureId texture, backend::TextureRange const& range, F&& visit) const {
        any(texture, range, [&](uint32_t number, uint8_t, uint16_t) { return visit(number), false; });
    }

    /// All of a texture.
    static backend::TextureRange all(GraphTextureDesc const& desc) { return { 0, desc.levels, 0, desc.layers }; }

private:
    FrameGraph const& mGraph;
    std::span<uint32_t> mFirst;
    uint32_t mCount = 0; // of textures; buffers come behind them
};

/// What a resolve writes.
inline constexpr backend::TextureRange kResolved{ 0, 1, 0, 1 };

} // namespace filament_core::framegraph
