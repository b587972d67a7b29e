// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/CommandBuffer.h"

#include "base/Assert.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>
#include <vector>

namespace filament_core::backend {
namespace {

/// Reserves room for `extra` more elements, so that adding them cannot fail; grows like push_back().
template <class T>
void reserveMore(std::vector<T>& vector, size_t extra) {
    const size_t needed = vector.size() + extra;
    if (needed > vector.capacity()) vector.reserve(std::max(needed, 2 * vector.capacity()));
}

/// Rounded up to a multiple of an eighth of the next power of two, so that a block also fits slightly larger contents.
size_t roundedSize(size_t bytes) {
    const size_t step = std::bit_ceil(bytes) / 8;
    return (bytes + step - 1) / step * step;
}

} // namespace

CommandBuffer::CommandBuffer() = default;
CommandBuffer::~CommandBuffer() = default;

CommandBuffer::CommandBuffer(CommandBuffer&& other) noexcept { *this = std::move(other); }

CommandBuffer& CommandBuffer::operator=(CommandBuffer&& other) noexcept {
    mCommands = std::exchange(other.mCommands, {});
    mReserve = std::exchange(other.mReserve, 0);
    mPayload = std::exchange(other.mPayload, {});
    mChunks = std::exchange(other.mChunks, {});
    mUsed = std::exchange(other.mUsed, {});
    mSpare = std::exchange(other.mSpare, {});
    mKept = std::exchange(other.mKept, {});
    mCommandCount = std::exchange(other.mCommandCount, 0);
    mKinds = std::exchange(other.mKinds, 0);
    mPayloadBytes = std::exchange(other.mPayloadBytes, 0);
    return *this;
}

// Takes the smallest spare block that is large enough, or allocates one, so that large blocks remain for large
// payloads. Everything that may fail comes first; mSpare always has room to take every block back.
CommandBuffer::Block& CommandBuffer::takeBlock(size_t bytes) {
    reserveMore(mUsed, 1);
    reserveMore(mSpare, mUsed.size() + 1);
    const size_t size = roundedSize(std::max(bytes, kBlockBytes));
    size_t best = mSpare.size();
    for (size_t i = mSpare.size(); i-- > 0;) {
        if (mSpare[i].size >= size && (best == mSpare.size() || mSpare[i].size < mSpare[best].size)) best = i;
        if (best < mSpare.size() && mSpare[best].size == size) break; // a perfect fit
    }
    if (best < mSpare.size()) return mUsed.emplace_back(takeSpare(best));
    auto* data = static_cast<std::byte*>(::operator new[](size, std::align_val_t{ kBlockAlignment }));
    return mUsed.emplace_back(Block{ std::unique_ptr<std::byte[], FreeAligned>(data), size });
}

CommandBuffer::Block CommandBuffer::takeSpare(size_t index) {
    std::swap(mSpare[index], mSpare.back());
    Block block = std::move(mSpare.back());
    block.idleFrames = 0;
    mSpare.pop_back();
    return block;
}

void CommandBuffer::startChunk(size_t bytes) {
    seal();
    reserveMore(mChunks, 1);
    Block const& block = takeBlock(bytes + kReservedBytes);
    useForCommands(block, block.data.get());
    mChunks.push_back({ block.data.get(), 0 });
}

void CommandBuffer::useForCommands(Block const& block, std::byte* from) {
    mCommands = { from, block.data.get() + block.size - kReservedBytes };
    mReserve = kReservedBytes;
}

std::span<std::byte> CommandBuffer::allocate(size_t bytes, size_t alignment) {
    FILAMENT_ASSERT(alignment > 0 && alignment <= kBlockAlignment && (alignment & (alignment - 1)) == 0,
                    "payload alignment is a power of two up to 64");
    const size_t padding = (0 - reinterpret_cast<uintptr_t>(mPayload.at)) & (alignment - 1);
    if (bytes <= mPayload.left() && padding <= mPayload.left() - bytes) {
        std::byte* data = mPayload.at + padding;
        mPayload.at = data + bytes;
        mPayloadBytes += bytes;
        return { data, bytes };
    }
    Block const& block = takeBlock(bytes);
    const Range rest{ block.data.get() + bytes, block.data.get() + block.size };
    // The range with more room left takes the next payloads.
    if (rest.left() >= mPayload.left()) mPayload = rest;
    mPayloadBytes += bytes;
    return { block.data.get(), bytes };
}

// Gives the tail a spare block of the same size in return for each of its blocks: joining the same buffers every frame
// then allocates nothing, and large blocks stay where they are needed.
void CommandBuffer::returnEqualBlock(size_t size, CommandBuffer& tail) {
    for (size_t i = mSpare.size(); i-- > 0;) {
        if (mSpare[i].size != size) continue;
        tail.mSpare.push_back(takeSpare(i));
        return;
    }
}

void CommandBuffer::append(CommandBuffer&& tail) {
    FILAMENT_ASSERT(&tail != this, "a command buffer cannot be appended to itself");
    reserveMore(mChunks, tail.mChunks.size());
    reserveMore(mUsed, tail.mUsed.size());
    reserveMore(mSpare, mUsed.size() + tail.mUsed.size());
    reserveMore(mKept, tail.mKept.size());
    reserveMore(tail.mSpare, tail.mUsed.size()); // nothing below allocates
    if (!tail.mChunks.empty()) {
        seal();
        tail.seal();
        mChunks.insert(mChunks.end(), tail.mChunks.begin(), tail.mChunks.end());
        mCommands = tail.mCommands;
        mReserve = tail.mReserve;
    }
    if (tail.mPayload.left() > mPayload.left()) mPayload = tail.mPayload;
    mCommandCount += tail.mCommandCount;
    mKinds |= tail.mKinds;
    mPayloadBytes += tail.mPayloadBytes;

    for (Block& block : tail.mUsed) {
        returnEqualBlock(block.size, tail);
        mUsed.push_back(std::move(block));
    }
    std::ranges::move(tail.mKept, std::back_inserter(mKept));
    tail.mKept.clear();
    tail.mUsed.clear();
    tail.mChunks.clear();
    tail.mCommands = tail.mPayload = {};
    tail.mCommandCount = tail.mPayloadBytes = tail.mReserve = tail.mKinds = 0;
}

void CommandBuffer::rollBack(Mark const& mark) {
    mChunks.resize(mark.chunks);
    mCommandCount = mark.commandCount;
    mCommands = {};
    mReserve = 0;
    if (mark.chunks == 0) return;
    const std::byte* const chunk = mChunks.back().data;
    // Blocks that were taken since stay in use until the reset: payloads of kept commands may lie in them.
    const auto block = std::ranges::find_if(mUsed, [&](Block const& used) { return used.data.get() == chunk; });
    FILAMENT_ASSERT(block != mUsed.end(), "a mark belongs to the buffer that gave it, until its reset()");
    useForCommands(*block, mark.commands);
    seal();
}

void CommandBuffer::reset() {
    // Only what was not used since the last reset grows older: the blocks in use join the spare ones afterwards.
    std::erase_if(mSpare, [](Block& block) {
        ++block.idleFrames;
        return block.size > kKeptBytes || (block.size > kBlockBytes && block.idleFrames >= kIdleFrames);
    });
    std::move(mUsed.begin(), mUsed.end(), std::back_inserter(mSpare));
    mUsed.clear();
    mKept.clear();
    mChunks.clear();
    mCommands = mPayload = {};
    mCommandCount = mPayloadBytes = mReserve = mKinds = 0;
}

size_t CommandBuffer::commandCount() const { return mCommandCount; }

size_t CommandBuffer::bytesUsed() const {
    size_t sum = mPayloadBytes;
    for (CommandChunk const& chunk : view()) sum += chunk.size;
    return sum;
}

size_t CommandBuffer::bytesReserved() const {
    size_t sum = 0;
    for (Block const& block : mUsed) sum += block.size;
    for (Block const& block : mSpare) sum += block.size;
    return sum;
}

} // namespace filament_core::backend
