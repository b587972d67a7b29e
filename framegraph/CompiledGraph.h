// SPDX-License-Identifier: Apache-2.0
/// compile(): from declarations to a plan. record(): from a plan to commands. rehearse(): what recording would need.
/// CompiledGraph in between is plain data that records every decision and its reason; Explain.h prints it.
///   Thread  one at a time, for each pool.
///   Memory  the plan lives in the graph's arena and refers to graph and pool; valid until one of them is reset.
///   Fails   compile() asserts on a graph that breaks a rule, naming pass and texture (see Check.cpp).
///           std::bad_alloc leaves record() between two passes: what is recorded can be submitted.
///   Cost    declare 0.06, compile 1.1, record 0.06 us per pass, for 20 passes; compile() is quadratic in the number of
///           passes.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/stream/CommandBuffer.h"
#include "framegraph/FrameGraph.h"
#include "framegraph/TransientPool.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace filament_core::framegraph {

inline constexpr uint32_t kNone = ~0u;

/// Why a pass runs, or does not.
enum class Reason : uint8_t { Unread, SideEffect, WritesOutput, ReadLater };

/// Why a pass that reads an input at the current pixel is part of the pass before it, or is not.
enum class Merge : uint8_t {
    NotAsked, ///< the pass reads no input
    Merged,
    DeviceCannot, ///< DeviceFeatures::mergedPasses is false
    NotBefore,    ///< the pass before it, among those that run, did not write all of the inputs
    DifferentSize,
    Multisampled,
    OtherAttachments, ///< its program numbers its attachments otherwise
    ReadsElsewhere,   ///< samples or copies a texture of the merged pass as well
    ClearsAgain,      ///< clears an attachment that the merged pass already has
    DifferentDepth,   ///< needs another depth attachment
    TooManyAttachments,
    TooManySubpasses,
};

struct PassDecision {
    Reason reason = Reason::Unread;
    TextureId because{}; ///< WritesOutput, ReadLater: the texture, and which part of it
    uint8_t level = 0;
    uint16_t layer = 0;
    BufferId becauseBuffer{}; ///< instead of a texture
    uint32_t reader = kNone;  ///< ReadLater: the pass that reads it
    Merge merge = Merge::NotAsked;
    uint32_t group = kNone; ///< kNone: culled
    uint8_t subpass = 0;

    bool runs() const { return reason != Reason::Unread; }
};

/// An attachment of a group; load and store operations are those of the group, not of one subpass.
struct GroupAttachment {
    TextureId texture;
    uint8_t level = 0;
    uint16_t layer = 0;
    Previous previous = Previous::Keep; ///< of the first subpass that uses it
    std::array<float, 4> clear{};
    TextureId resolve{};
    backend::LoadOp load = backend::LoadOp::Discard;
    backend::StoreOp store = backend::StoreOp::Discard;
};

/// Passes that run as one: a backend pass with a subpass each, or a single pass without attachments.
struct PassGroup {
    uint32_t first = 0, count = 0; ///< in CompiledGraph::order
    uint32_t width = 0, height = 0;
    uint8_t samples = 1;
    uint8_t colorCount = 0;
    std::array<GroupAttachment, backend::kMaxColorAttachments> colors{};
    GroupAttachment depth{}; ///< texture: none if there is no depth attachment
    std::array<backend::SubpassDesc, backend::kMaxSubpasses> subpasses{};
    std::string_view name;
    backend::PassLayout layout{};

    bool hasAttachments() const { return colorCount > 0 || depth.texture; }
};

/// From the first to the last group that uses a texture.
struct Lifetime {
    uint32_t first = kNone, last = 0;
    bool isUsed() const { return first != kNone; }
};

struct TexturePlan {
    Lifetime lifetime;
    backend::TextureUsage usage{};
    backend::TextureHandle handle; ///< none if unused
    uint32_t memory = kNone;       ///< equal for transients that share it; none for other textures
    uint32_t historyAge = 0;       ///< HistoryRole::Previous: see PassContext::historyAge()
};

struct BufferPlan {
    Lifetime lifetime;
    backend::BufferUsage usage{};
    backend::BufferHandle handle; ///< none if unused
};

struct CompiledGraph {
    FrameGraph const* graph = nullptr;
    TransientPool* pool = nullptr;
    std::span<const PassDecision> passes; ///< by declaration
    std::span<const uint32_t> order;      ///< passes that run
    std::span<const PassGroup> groups;
    std::span<const TexturePlan> textures; ///< by TextureId::index()
    std::span<const BufferPlan> buffers;   ///< by BufferId::index()

    bool runs(PassId pass) const { return passes[pass.index()].runs(); }
    /// The layout for pipelines of a pass that runs and has attachments; use it with subpass().
    backend::PassLayout const& passLayout(PassId pass) const { return groups[passes[pass.index()].group].layout; }
    uint8_t subpass(PassId pass) const { return passes[pass.index()].subpass; }
    /// None if no pass that runs uses it.
    backend::TextureHandle texture(TextureId texture) const { return textures[texture.index()].handle; }
    backend::BufferHandle buffer(BufferId buffer) const { return buffers[buffer.index()].handle; }
};

/// Creates nothing: record() creates the textures that the pool lacks. Compile, record, then compile the next graph.
CompiledGraph compile(FrameGraph const& graph, TransientPool& pool);

struct PassTimer {
    std::string_view name; ///< as long as the plan lives
    backend::Ticket ticket;
};

/// Appends the whole frame. `timers`, if given, receives one ticket for each group, in order; the stream has the
/// results. `ranges`, if given, lets passes record their draws in parallel (PassContext::recordRanges); the bits are
/// the same.
void record(backend::CommandBuffer& commands, CompiledGraph const& plan, std::vector<PassTimer>* timers = nullptr,
            RangeRecorder* ranges = nullptr);

/// Calls beforePass of every pass that runs, in order, and nothing else, to find out in advance what such a frame
/// needs. Asserts that no pass records anything (PassContext::isRehearsal()).
void rehearse(CompiledGraph const& plan);

} // namespace filament_core::framegraph
