// SPDX-License-Identifier: Apache-2.0
/// PassContext: what the code of a pass sees while its commands are recorded. PassCode: that code, stored in an arena.
///   Thread  the one that calls record(); bodies of recordRanges(): any.
///   Memory  captures live in the graph's arena and are never destroyed: trivially destructible ones only.
///   Fails   asserts on textures that the pass did not declare, and on creating objects inside a pass.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/stream/CommandBuffer.h"
#include "base/Arena.h"
#include "framegraph/RangeRecorder.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

namespace filament_core::backend {
class CommandStream;
}

namespace filament_core::framegraph {

struct CompiledGraph;
struct GraphTextureDesc;

/// Names a texture of one graph until the graph's reset(); zero is none.
struct TextureId {
    uint32_t value = 0;
    uint32_t index() const { return value - 1; }
    explicit operator bool() const { return value != 0; }
    friend bool operator==(TextureId, TextureId) = default;
};

/// Names a buffer of one graph until the graph's reset(); zero is none.
struct BufferId {
    uint32_t value = 0;
    uint32_t index() const { return value - 1; }
    explicit operator bool() const { return value != 0; }
    friend bool operator==(BufferId, BufferId) = default;
};

/// Names a pass of one graph until the graph's reset(); zero is none.
struct PassId {
    uint32_t value = 0;
    uint32_t index() const { return value - 1; }
    explicit operator bool() const { return value != 0; }
    friend bool operator==(PassId, PassId) = default;
};

class PassContext {
public:
    PassContext(CompiledGraph const& plan, backend::CommandBuffer& commands, RangeRecorder* ranges = nullptr,
                bool isRehearsal = false)
            : mPlan(plan), mCommands(commands), mRanges(ranges), mIsRehearsal(isRehearsal) {}

    backend::CommandBuffer& commands() { return mCommands; }
    /// body(commands, begin, end) for the ranges [0, grain), [grain, 2 grain), ... of `count` items. They run in
    /// parallel if record() was given a RangeRecorder, and are joined in order after the contents of commands(). The
    /// stream does not depend on that: a body records into the buffer it is given, starts with nothing bound, and only
    /// reads shared data.
    template <class Body>
    void recordRanges(size_t count, size_t grain, Body&& body) {
        if (mRanges)
            mRanges->record(mCommands, count, grain, body);
        else
            recordRangesInTurn(mCommands, count, grain, body);
    }
    /// To allocate handles and tickets.
    backend::CommandStream& stream();

    /// body(begin, end) for the same ranges without recording: for work before recording.
    template <class Body>
    void forEachRange(size_t count, size_t grain, Body&& body) {
        if (mRanges)
            jobs::parallelFor<"look up">(mRanges->jobs(), count, grain, body);
        else
            for (size_t begin = 0; begin < count; begin += grain) body(begin, std::min(count, begin + grain));
    }

    /// The texture behind an id that this pass declared.
    backend::TextureHandle texture(TextureId id) const;
    GraphTextureDesc const& desc(TextureId id) const;
    /// The buffer behind an id that this pass declared.
    backend::BufferHandle buffer(BufferId id) const;

    /// How many graphs ago History::previous, which this pass declared, was written: 1 for the graph before this one.
    /// 0: never, with another description, or it is reset; it holds the clear value.
    uint32_t historyAge(TextureId previous) const;

    /// The layout for pipelines of this pass. Passes without attachments have none.
    backend::PassLayout const& passLayout() const;
    uint8_t subpass() const;
    backend::Rect area() const;
    /// True: the texture is a subpass input (BindingType::InputAttachment). False: the pass must sample it.
    bool isMerged(TextureId id) const;
    /// Index of a colour attachment of this pass, or of its subpass input, in the backend pass: the output location
    /// that the fragment shader writes, and BindingDesc::inputAttachment. The declared slot, unless the pass is merged.
    uint8_t colorIndex(TextureId id) const;

    /// rehearse() called beforePass: nothing will be drawn. Choose pipelines as usual, but record nothing.
    bool isRehearsal() const { return mIsRehearsal; }

    /// A bind group that lives for this frame; equal ones are created once and kept while frames request them. None in
    /// a rehearsal. Only in `beforePass` and in passes without attachments. Asserts that what it shows of a texture of
    /// the graph lies within what the pass declared to read.
    backend::BindGroupHandle bindGroup(backend::BindGroupLayout const& layout,
                                       std::span<const backend::BindGroupEntry> entries, std::string_view name);

    // For record():
    void enter(uint32_t pass, bool insidePass) { mPass = pass, mInsidePass = insidePass; }

private:
    void requireDeclared(TextureId id) const;
    void requireDeclaredRange(backend::BindGroupEntry const& entry, std::string_view group) const;

    CompiledGraph const& mPlan;
    backend::CommandBuffer& mCommands;
    RangeRecorder* mRanges;
    uint32_t mPass = 0;
    bool mInsidePass = false;
    const bool mIsRehearsal;
};

struct PassCode {
    void* object = nullptr;
    void (*beforePass)(void* object, PassContext& context) = nullptr;
    void (*execute)(void* object, PassContext& context) = nullptr;
};

template <class BeforePass, class Execute>
PassCode makePassCode(Arena& arena, BeforePass&& beforePass, Execute&& execute) {
    using Value = std::invoke_result_t<std::decay_t<BeforePass>&, PassContext&>;
    static_assert(!std::is_void_v<Value>, "beforePass returns what execute needs");
    struct Code {
        std::decay_t<BeforePass> beforePass;
        std::decay_t<Execute> execute;
        std::optional<Value> value;
    };
    static_assert(std::is_trivially_destructible_v<Code>,
                  "pass code is never destructed: capture handles, ids, spans and plain values, by value");
    return {
        arena.make<Code>(std::forward<BeforePass>(beforePass), std::forward<Execute>(execute), std::nullopt),
        [](void* object, PassContext& context) {
            Code& code = *static_cast<Code*>(object);
            code.value.emplace(code.beforePass(context));
        },
        [](void* object, PassContext& context) {
            Code& code = *static_cast<Code*>(object);
            code.execute(context, *code.value);
        },
    };
}

} // namespace filament_core::framegraph
