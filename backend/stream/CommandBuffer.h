// SPDX-License-Identifier: Apache-2.0
/// CommandBuffer: a recorded stream. Commands are plain structs in linear chunks; payloads live beside them.
///   Thread  one recorder at a time. Several buffers may be recorded in parallel and joined in order with append().
///   Memory  chunks of 64 KiB, larger for larger payloads; grows without limit, never aborts, never overruns.
///           reset() keeps the chunks, so that steady frames allocate nothing, also if payloads are a little larger in
///           some of them than in others: sizes are rounded up by at most a quarter. A larger chunk is freed once
///           kIdleFrames frames in a row did not need it, one of more than kKeptBytes after the first such frame.
///   Fails   record(), allocate(), keep(), append(): std::bad_alloc, and nothing has changed. reset(), rollBack() and
///           recordInReserve() never fail: a caller that runs out of memory in the middle can still end what it began.
///   Names   every span and string_view given to record() inside a command is copied into the buffer. Large payloads
///           that their owner gives away need no copy: keep() and recordAdopted().
#pragma once

#include "backend/api/Commands.h"
#include "backend/stream/CommandPayload.h"

#include <cstring>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace filament_core::backend {

class CommandBuffer {
public:
    static constexpr uint32_t kIdleFrames = 60;
    static constexpr size_t kKeptBytes = size_t{ 1 } << 20;

    CommandBuffer();
    ~CommandBuffer();
    CommandBuffer(CommandBuffer&&) noexcept;
    CommandBuffer& operator=(CommandBuffer&&) noexcept;

    /// Appends a command, copying what its spans point to.
    template <class C>
    void record(C command) {
        adopt(command);
        append(command);
    }

    /// Uninitialised payload memory that lives as long as this buffer's contents; align <= 64. Point a command's span
    /// at it and call recordAdopted() to avoid the copy (large uploads).
    std::span<std::byte> allocate(size_t bytes, size_t alignment = 16);

    /// Shares the ownership of memory that commands point to until reset(), which drops it on the thread that replays.
    void keep(std::shared_ptr<const void> payload) { mKept.push_back(std::move(payload)); }

    /// record() for commands whose spans already point into this buffer, or into what it keeps.
    template <class C>
    void recordAdopted(C const& command) {
        append(command);
    }

    /// record() that cannot fail, for a command without payload, in room that every buffer with a command reserves: for
    /// the ends of a frame, a timer and a group, once each. False if nothing was ever recorded.
    template <class C>
    bool recordInReserve(C const& command) {
        static_assert(!kHasPayload<C>, "payloads need memory of their own");
        constexpr size_t kBytes = bytesOf<C>();
        static_assert(kBytes <= kReservedBytes);
        if (kBytes > mCommands.left() && mReserve >= kBytes) {
            mCommands.end += mReserve;
            mReserve = 0;
        }
        if (kBytes > mCommands.left()) return false;
        append(command);
        return true;
    }

    /// A position in the stream, valid until the next reset() or append() of this buffer to another.
    struct Mark {
        std::byte* commands = nullptr;
        size_t chunks = 0, commandCount = 0;
    };
    Mark mark() const { return { mCommands.at, mChunks.size(), mCommandCount }; }
    /// Drops the commands since mark(); their payloads stay until reset(). contains() may still report them.
    void rollBack(Mark const& mark);

    /// Appends all commands of `tail`, which is then empty.
    void append(CommandBuffer&& tail);

    void reset();
    /// Valid until the next record() or reset().
    CommandView view() const {
        seal();
        return mChunks;
    }
    size_t commandCount() const;
    /// Whether a command of type C is among them.
    template <class C>
    bool contains() const {
        return (mKinds >> kCommandId<C> & 1) != 0;
    }
    size_t bytesUsed() const;
    size_t bytesReserved() const;

private:
    struct FreeAligned {
        void operator()(std::byte* data) const { ::operator delete[](data, std::align_val_t{ kBlockAlignment }); }
    };
    struct Block {
        std::unique_ptr<std::byte[], FreeAligned> data;
        size_t size = 0;
        uint32_t idleFrames = 0; // calls of reset() since it was used
    };
    struct Range {
        std::byte* at = nullptr;
        std::byte* end = nullptr;
        size_t left() const { return static_cast<size_t>(end - at); }
    };
    static constexpr size_t kBlockBytes = 64 * 1024;
    static constexpr size_t kBlockAlignment = 64;
    static constexpr size_t kReservedBytes = 64; // at the end of every block of commands

    template <class C>
    void adopt(C& command) {
        if constexpr (kHasPayload<C>) adoptPayload(command, *this);
    }

    template <class C>
    static constexpr size_t bytesOf() {
        return (2 * kCommandAlignment - 1 + sizeof(C)) & ~(kCommandAlignment - 1);
    }

    template <class C>
    void append(C const& command) {
        static_assert(Commands::kCount <= 64, "mKinds has a bit for each command");
        static_assert(alignof(C) <= kCommandAlignment && std::is_trivially_copyable_v<C>, "a command is plain data");
        constexpr size_t kBytes = bytesOf<C>();
        if (kBytes > mCommands.left()) [[unlikely]]
            startChunk(kBytes);
        std::byte* const at = mCommands.at;
        new (at) CommandHeader{ kCommandId<C>, static_cast<uint32_t>(kBytes) };
        new (at + kCommandAlignment) C(command); // in place, without a copy on the stack
        mCommands.at = at + kBytes;
        ++mCommandCount;
        mKinds |= uint64_t{ 1 } << kCommandId<C>;
    }

    /// Writes the size of the newest chunk, which is derived from mCommands on demand instead of with each command.
    void seal() const {
        if (mChunks.empty()) return;
        CommandChunk& newest = mChunks.back();
        const auto size = static_cast<size_t>(mCommands.at - newest.data);
        if (newest.size != size) newest.size = size; // a buffer that is only read is not written to
    }
    Block& takeBlock(size_t bytes);
    Block takeSpare(size_t index);
    void useForCommands(Block const& block, std::byte* from);
    void returnEqualBlock(size_t size, CommandBuffer& tail);
    void startChunk(size_t bytes);

    Range mCommands, mPayload;                 // what is left of the newest block of each kind
    size_t mReserve = 0;                       // bytes behind mCommands for recordInReserve()
    mutable std::vector<CommandChunk> mChunks; // command blocks in order
    std::vector<Block> mUsed;                  // owns the memory of commands and payloads
    std::vector<Block> mSpare;                 // kept for the next frame
    std::vector<std::shared_ptr<const void>> mKept;
    size_t mCommandCount = 0;
    uint64_t mKinds = 0; // bit kCommandId<C>: contains<C>()
    size_t mPayloadBytes = 0;
};

} // namespace filament_core::backend
