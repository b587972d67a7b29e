// SPDX-License-Identifier: Apache-2.0
/// Barriers: makes commands that run in parallel on the GPU look serial.
///   What is known  the last Use of every level and layer of every texture; which kinds of commands wrote buffers that
///                  no barrier covers yet, and which stages read buffers since a writer last waited for them.
///   How            image(), bufferWrite(), ... collect what the next command needs; flush() emits it as one
///                  vkCmdPipelineBarrier, or nothing. Sampled textures go back to ShaderRead together, when the next
///                  pass or dispatch begins, so that uploads, blits and passes in a row cost one barrier, not one each.
///                  Buffers share one state, except for transfers in a row: writes become visible to all.
///                  Textures that share memory: one that is used takes it, and the one that had it has no contents.
///   Thread  the driver thread.
///   Limits  a level and layer that is an attachment of a pass is not sampled in it.
#pragma once

#include "backend/vulkan/Api.h"

#include <cstdint>
#include <vector>

namespace filament_core::backend::vulkan {

class Buffer;
class Texture;

/// How a level and layer was used last.
enum class Use : uint8_t {
    Undefined, ///< no contents yet
    TransferRead,
    TransferWrite,
    ShaderRead, ///< where sampled textures rest
    ColorAttachment,
    DepthAttachment,
    DepthResolve, ///< depth attachment that was resolved, and the target of that
    InputRead,    ///< colour attachment that the last subpass using it read as an input attachment
    Count,
};

struct UseInfo {
    VkImageLayout layout;
    VkPipelineStageFlags stages;
    VkAccessFlags access;  ///< all of it
    VkAccessFlags written; ///< the writes among it
};
UseInfo const& infoOf(Use use);

struct SubresourceRange {
    uint32_t level = 0, levelCount = 1, layer = 0, layerCount = 1;
    friend bool operator==(SubresourceRange const&, SubresourceRange const&) = default;
};

/// The Use of each level and layer of one texture; knows no device.
class SubresourceUses {
public:
    SubresourceUses(uint32_t levels, uint32_t layers);

    Use at(uint32_t level, uint32_t layer) const { return mUses[level * mLayers + layer]; }
    void set(SubresourceRange const& range, Use use);
    SubresourceRange all() const { return { 0, mLevels, 0, mLayers }; }

    /// Calls visit(part, use) for parts that cover the range: one if all of it has the same use, else runs of layers.
    template <class F>
    void forEachPart(SubresourceRange const& range, F&& visit) const {
        if (isUniform(range)) return visit(range, at(range.level, range.layer));
        const uint32_t end = range.layer + range.layerCount;
        for (uint32_t level = range.level; level < range.level + range.levelCount; ++level) {
            for (uint32_t first = range.layer, last = first; first < end; first = last) {
                while (last < end && at(level, last) == at(level, first)) ++last;
                visit(SubresourceRange{ level, 1, first, last - first }, at(level, first));
            }
        }
    }

private:
    bool isUniform(SubresourceRange const& range) const;

    uint32_t mLevels, mLayers;
    std::vector<Use> mUses; // [level][layer]
};

enum class Contents : uint8_t { Keep, Discard };

class Barriers {
public:
    /// The next command uses `range` in that way.
    void image(Texture& texture, SubresourceRange const& range, Use use, Contents contents = Contents::Keep);
    /// The pass that has just ended left `range` like this; no barrier.
    void leave(Texture& texture, SubresourceRange const& range, Use use);
    /// The next command is a transfer that writes bytes [begin, end) of the buffer.
    void bufferWrite(Buffer& buffer, uint64_t begin, uint64_t end);
    /// The next command is a transfer that reads a buffer of the stream.
    void bufferRead();
    /// The host will read what transfers have written so far.
    void hostRead();
    /// image(), for an attachment of the pass that beginPass() begins.
    void attach(Texture& texture, SubresourceRange const& range, Use use, Contents contents);
    /// The next command begins a pass: transfers become visible, and what shaders may sample becomes readable, except
    /// for the attachments.
    void beginPass();
    void endPass();
    /// The next command is a dispatch: as beginPass(), without attachments.
    void beginDispatch();
    void endDispatch();
    /// A new texture that shaders may sample before anything has written it.
    void add(Texture& texture);
    void forget(Texture& texture);

    bool isEmpty() const { return mSourceStages == 0; }
    void flush(VolkDeviceTable const& fn, VkCommandBuffer commands);

private:
    struct Attached {
        Texture* texture = nullptr;
        SubresourceRange range;
    };

    bool isAttached(Texture const& texture, uint32_t level, uint32_t layer) const;
    /// Makes all of the texture readable that is not attached; whether that is everything.
    bool settle(Texture& texture);
    void settleAll();
    /// The memory of the texture becomes its own: what others did with it comes before `next`.
    void takeMemory(Texture& texture, UseInfo const& next);
    /// Makes what transfers and dispatches wrote to buffers visible to every command.
    void publishWrites();
    void memory(VkPipelineStageFlags sourceStages, VkAccessFlags written, VkPipelineStageFlags targetStages,
                VkAccessFlags access);

    VkPipelineStageFlags mSourceStages = 0, mTargetStages = 0;
    VkAccessFlags mWritten = 0, mAccess = 0; // of the global memory barrier
    bool mHasMemoryBarrier = false;
    std::vector<VkImageMemoryBarrier> mImages;

    std::vector<Texture*> mUnsettled;  // sampled textures with some part not in ShaderRead
    std::vector<Attached> mAttached;   // of the pass that is about to begin
    uint64_t mTransferEpoch = 1;       // transfers of one epoch are not ordered among each other
    bool mTransferWrites = false;      // to buffers, not yet visible to shaders
    bool mStorageWrites = false;       // of dispatches, not yet visible to anything
    VkPipelineStageFlags mReaders = 0; // that have read buffers since a writer last waited for them
};

} // namespace filament_core::backend::vulkan
