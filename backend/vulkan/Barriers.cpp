// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Barriers.h"

#include "backend/vulkan/Buffer.h"
#include "backend/vulkan/Texture.h"

#include <algorithm>
#include <array>

namespace filament_core::backend::vulkan {
namespace {

constexpr VkPipelineStageFlags kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags kDrawShaders =
        VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags kShaders = kDrawShaders | kCompute;
constexpr VkPipelineStageFlags kDepthTests =
        VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags kDrawReaders = VK_PIPELINE_STAGE_VERTEX_INPUT_BIT | kDrawShaders;
constexpr VkAccessFlags kBufferAccess = VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_INDEX_READ_BIT |
                                        VK_ACCESS_UNIFORM_READ_BIT | VK_ACCESS_SHADER_READ_BIT |
                                        VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                                        VK_ACCESS_TRANSFER_WRITE_BIT;
constexpr VkAccessFlags kColorAccess = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
constexpr VkAccessFlags kDepthAccess =
        VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

constexpr std::array<UseInfo, static_cast<size_t>(Use::Count)> kUses{ {
        { VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0, 0 },
        { VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT, 0 },
        { VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
          VK_ACCESS_TRANSFER_WRITE_BIT },
        { VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, kShaders, VK_ACCESS_SHADER_READ_BIT, 0 },
        { VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, kColorAccess,
          VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT },
        { VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, kDepthTests, kDepthAccess,
          VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT },
        // A resolve is a colour output, even for depth (Vulkan 1.2, 7.1.2 and 8.4).
        { VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, kDepthTests | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
          kDepthAccess | kColorAccess,
          VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT },
        // Load and store operations and earlier subpasses write it as a colour attachment.
        { VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
          VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
          kColorAccess | VK_ACCESS_INPUT_ATTACHMENT_READ_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT },
} };

} // namespace

UseInfo const& infoOf(Use use) { return kUses[static_cast<size_t>(use)]; }

SubresourceUses::SubresourceUses(uint32_t levels, uint32_t layers)
        : mLevels(levels), mLayers(layers), mUses(size_t{ levels } * layers, Use::Undefined) {}

void SubresourceUses::set(SubresourceRange const& range, Use use) {
    for (uint32_t level = range.level; level < range.level + range.levelCount; ++level) {
        std::fill_n(mUses.begin() + level * mLayers + range.layer, range.layerCount, use);
    }
}

bool SubresourceUses::isUniform(SubresourceRange const& range) const {
    const Use first = at(range.level, range.layer);
    for (uint32_t level = range.level; level < range.level + range.levelCount; ++level) {
        const Use* const uses = mUses.data() + level * mLayers + range.layer;
        if (!std::all_of(uses, uses + range.layerCount, [first](Use use) { return use == first; })) return false;
    }
    return true;
}

void Barriers::image(Texture& texture, SubresourceRange const& range, Use use, Contents contents) {
    UseInfo const& next = infoOf(use);
    // First: it forgets the uses of this texture, which the parts below are compared with.
    if (!texture.hasMemory()) takeMemory(texture, next);
    texture.uses.forEachPart(range, [&](SubresourceRange const& part, Use before) {
        if (before == use && next.written == 0) return; // a read after a read
        const bool isNew = before == Use::Undefined;    // in memory that others, or other parts, may have written
        UseInfo const& last = infoOf(before);
        auto barrier = make<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
        barrier.srcAccessMask = isNew ? texture.memory().written : last.written;
        barrier.dstAccessMask = next.access;
        // From the undefined layout nothing needs to be converted or decompressed.
        barrier.oldLayout = contents == Contents::Discard ? VK_IMAGE_LAYOUT_UNDEFINED : last.layout;
        barrier.newLayout = next.layout;
        barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = texture.image();
        barrier.subresourceRange = { texture.aspects(), part.level, part.levelCount, part.layer, part.layerCount };
        mImages.push_back(barrier);
        mSourceStages |= isNew ? texture.memory().writingStages | last.stages : last.stages;
        mTargetStages |= next.stages;
    });
    leave(texture, range, use);
}

void Barriers::takeMemory(Texture& texture, UseInfo const& next) {
    ImageMemory const& shared = texture.memory();
    // What had the memory may still be read: its readers must have finished, which needs no memory dependency. All
    // writes to the memory, by whichever texture, must be available before the first new one.
    if (Texture* const last = texture.takeMemory()) {
        // Its contents are gone: making them readable would only cost a barrier.
        forget(*last);
        last->uses.forEachPart(last->uses.all(), [&](SubresourceRange const&, Use use) {
            memory(infoOf(use).stages, 0, next.stages, next.access); // readers
        });
        last->uses.set(last->uses.all(), Use::Undefined);
    }
    if (shared.written != 0) memory(shared.writingStages, shared.written, next.stages, next.access);
    texture.uses.set(texture.uses.all(), Use::Undefined);
}

void Barriers::leave(Texture& texture, SubresourceRange const& range, Use use) {
    texture.uses.set(range, use);
    if (infoOf(use).written != 0) {
        texture.memory().writingStages |= infoOf(use).stages;
        texture.memory().written |= infoOf(use).written;
    }
    if (use != Use::ShaderRead) add(texture);
}

void Barriers::add(Texture& texture) {
    if (!texture.isSampled() || texture.isUnsettled) return;
    texture.isUnsettled = true;
    mUnsettled.push_back(&texture);
}

void Barriers::forget(Texture& texture) {
    if (texture.isUnsettled) std::erase(mUnsettled, &texture);
    texture.isUnsettled = false;
}

void Barriers::bufferWrite(Buffer& buffer, uint64_t begin, uint64_t end) {
    // A dispatch may have written these very bytes, and the copy must come after.
    if (mStorageWrites) publishWrites();
    // A write after a read needs an execution dependency only: there is nothing to make available.
    if (mReaders != 0) memory(mReaders, 0, kTransfer, VK_ACCESS_TRANSFER_WRITE_BIT); // of what is overwritten next
    mReaders = 0;
    // Uploads of a frame mostly go to separate ranges and may run in any order. Those that overlap must not.
    if (buffer.overlapsWrites(mTransferEpoch, begin, end)) {
        memory(kTransfer, VK_ACCESS_TRANSFER_WRITE_BIT, kTransfer, VK_ACCESS_TRANSFER_WRITE_BIT);
        ++mTransferEpoch;
    }
    buffer.addWrite(mTransferEpoch, begin, end);
    mTransferWrites = true;
}

void Barriers::bufferRead() {
    publishWrites();
    mReaders |= kTransfer;
}

void Barriers::publishWrites() {
    VkPipelineStageFlags stages = 0;
    VkAccessFlags written = 0;
    if (mTransferWrites) stages |= kTransfer, written |= VK_ACCESS_TRANSFER_WRITE_BIT;
    if (mStorageWrites) stages |= kCompute, written |= VK_ACCESS_SHADER_WRITE_BIT;
    if (stages == 0) return;
    // To all readers at once: the uploads come together, before the first pass, and later passes then need no barrier
    // of their own.
    memory(stages, written, kDrawReaders | kCompute | kTransfer, kBufferAccess);
    mTransferWrites = mStorageWrites = false;
    ++mTransferEpoch;
}

void Barriers::hostRead() {
    memory(kTransfer, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

void Barriers::attach(Texture& texture, SubresourceRange const& range, Use use, Contents contents) {
    image(texture, range, use, contents);
    mAttached.push_back({ &texture, range });
}

bool Barriers::isAttached(Texture const& texture, uint32_t level, uint32_t layer) const {
    return std::ranges::any_of(mAttached, [&](Attached const& at) {
        return at.texture == &texture && level - at.range.level < at.range.levelCount &&
               layer - at.range.layer < at.range.layerCount; // unsigned: values below the range wrap to huge ones
    });
}

bool Barriers::settle(Texture& texture) {
    if (!texture.hasMemory()) return true; // another one has it: there is nothing to read
    if (std::ranges::find(mAttached, &texture, &Attached::texture) == mAttached.end()) {
        image(texture, texture.uses.all(), Use::ShaderRead);
        return true;
    }
    // A pass that writes one level or layer may read the others, as chains of smaller and smaller images do.
    for (uint32_t level = 0; level < texture.levels(); ++level) {
        for (uint32_t layer = 0; layer < texture.layers(); ++layer) {
            if (!isAttached(texture, level, layer)) image(texture, { level, 1, layer, 1 }, Use::ShaderRead);
        }
    }
    return false;
}

void Barriers::beginPass() {
    publishWrites();
    settleAll();
    // After settling, which leaves out what is attached.
    mAttached.clear();
}

void Barriers::endPass() { mReaders |= kDrawReaders; }

void Barriers::beginDispatch() {
    publishWrites();
    if (mReaders != 0) memory(mReaders, 0, kCompute, VK_ACCESS_SHADER_WRITE_BIT); // of what the dispatch overwrites
    mReaders = 0;
    settleAll();
}

void Barriers::endDispatch() {
    mStorageWrites = true;
    mReaders |= kCompute;
}

void Barriers::settleAll() {
    std::erase_if(mUnsettled, [this](Texture* texture) {
        texture->isUnsettled = !settle(*texture);
        return !texture->isUnsettled;
    });
}

void Barriers::memory(VkPipelineStageFlags sourceStages, VkAccessFlags written, VkPipelineStageFlags targetStages,
                      VkAccessFlags access) {
    mSourceStages |= sourceStages;
    mTargetStages |= targetStages;
    mWritten |= written;
    mAccess |= access;
    mHasMemoryBarrier = true;
}

void Barriers::flush(VolkDeviceTable const& fn, VkCommandBuffer commands) {
    if (isEmpty()) return;
    auto barrier = make<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = mWritten;
    barrier.dstAccessMask = mAccess;
    fn.vkCmdPipelineBarrier(commands, mSourceStages, mTargetStages, 0, mHasMemoryBarrier ? 1 : 0, &barrier, 0, nullptr,
                            static_cast<uint32_t>(mImages.size()), mImages.data());
    mImages.clear();
    mSourceStages = mTargetStages = 0;
    mWritten = mAccess = 0;
    mHasMemoryBarrier = false;
}

} // namespace filament_core::backend::vulkan
