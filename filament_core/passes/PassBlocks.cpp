// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/PassBlocks.h"

#include "backend/stream/RecordingGuards.h"

#include <bit>
#include <utility>

namespace filament_core::passes {

using namespace backend;

namespace {

constexpr size_t kFirstBytes = 4096; // 16 blocks if offsets are multiples of 256

} // namespace

void PassBlocks::begin() {
    mCurrent = (mCurrent + 1) % static_cast<uint32_t>(mSets.size());
    mBytes.clear();
}

PassBlock PassBlocks::add(std::span<const std::byte> bytes) {
    const size_t alignment = mStream.info().limits.uniformOffsetAlignment;
    const size_t offset = (mBytes.size() + alignment - 1) / alignment * alignment;
    mBytes.resize(offset + bytes.size());
    std::copy(bytes.begin(), bytes.end(), mBytes.begin() + static_cast<std::ptrdiff_t>(offset));
    return { static_cast<uint32_t>(offset), static_cast<uint32_t>(bytes.size()) };
}

void PassBlocks::upload(CommandBuffer& commands) {
    if (mBytes.empty()) return;
    Set& set = mSets[mCurrent];
    if (mBytes.size() > set.bytes) {
        if (set.buffer) mStream.destroy(commands, std::exchange(set.buffer, {}));
        set.bytes = 0;
        // To a power of two: frames that need a little more each time create few buffers.
        const size_t grown = std::max(kFirstBytes, std::bit_ceil(mBytes.size()));
        NewHandle buffer(mStream, mStream.allocateBuffer());
        commands.record(CmdCreateBuffer{ buffer, { grown, BufferUsage::Uniform, "pass blocks" } });
        set = { buffer.keep(), grown };
    }
    commands.record(CmdUpdateBuffer{ set.buffer, 0, mBytes });
}

BindGroupEntry PassBlocks::entry(uint8_t binding, PassBlock block) const {
    return { .binding = binding, .buffer = mSets[mCurrent].buffer, .offset = block.offset, .size = block.bytes };
}

void PassBlocks::destroy(CommandBuffer& commands) {
    for (Set& set : mSets) {
        if (set.buffer) mStream.destroy(commands, set.buffer);
        set = {};
    }
}

} // namespace filament_core::passes
