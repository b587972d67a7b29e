// SPDX-License-Identifier: Apache-2.0
/// The handles of everything that a driver owns. The recording side (backend/stream) allocates them, so creating never
/// waits.
#pragma once

#include "base/Handle.h"

namespace filament_core::backend {

using BufferHandle = Handle<struct BufferTag>;
using TextureHandle = Handle<struct TextureTag>;
using SamplerHandle = Handle<struct SamplerTag>;
using ProgramHandle = Handle<struct ProgramTag>;
using PipelineHandle = Handle<struct PipelineTag>;
using BindGroupHandle = Handle<struct BindGroupTag>;
using SurfaceHandle = Handle<struct SurfaceTag>; ///< a window that images are presented to

/// Identifies one result of the driver (a read-back, a timer). Never reused within a process; zero is none.
struct Ticket {
    uint64_t value = 0;
    explicit operator bool() const { return value != 0; }
    friend bool operator==(Ticket, Ticket) = default;
    friend auto operator<=>(Ticket, Ticket) = default;
};

} // namespace filament_core::backend

template <>
struct std::hash<filament_core::backend::Ticket> {
    size_t operator()(filament_core::backend::Ticket ticket) const noexcept {
        return std::hash<uint64_t>{}(ticket.value);
    }
};
