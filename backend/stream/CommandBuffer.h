// SPDX-License-Identifier: Apache-2.0
/// CommandBuffer: a recorded stream. Commands are plain structs in linear chunks; payloads live beside them.
///   Thread  one recorder at a time. Several buffers may be recorded in parallel and joined in order with append().
///   Memory  chunks of 64 KiB, larger for larger payloads; grows without limit, never aborts, never overruns. reset() keeps
///           the chunks, so a steady frame allocates nothing.
///   Names   every span and string_view given to record() inside a command is copied into the buffer.
#pragma once

#include "backend/api/Commands.h"

#include <cstring>
#include <memory>
#include <new>
#include <vector>

namespace filament::backend {

class CommandBuffer {
public:
    CommandBuffer();
    ~CommandBuffer();
    CommandBuffer(CommandBuffer&&) noexcept;
    CommandBuffer& operator=(CommandBuffer&&) noexcept;

    /// Appends a command, copying what its spans point to.
    template <class C>
    void record(C command) {
        adopt(command);
        append(kCommandId<C>, &command, sizeof(C), alignof(C));
    }

    /// Uninitialised payload memory that lives as long as this buffer's contents; align <= 64. Point a command's span
    /// at it and use recordAdopted() to avoid the copy (large uploads).
    std::span<std::byte> allocate(size_t bytes, size_t alignment = 16);

    /// record() for commands whose spans already point into this buffer.
    template <class C>
    void recordAdopted(C const& command) { append(kCommandId<C>, &command, sizeof(C), alignof(C)); }

    /// Moves all commands of `tail` behind the ones here; `tail` is left empty.
    void append(CommandBuffer&& tail);

    void reset();
    CommandView view() const;   ///< valid until the next record() or reset()
    size_t commandCount() const;
    size_t bytesUsed() const;
    size_t bytesReserved() const;
};

} // namespace filament::backend
