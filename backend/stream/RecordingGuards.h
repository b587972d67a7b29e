// SPDX-License-Identifier: Apache-2.0
/// Keep a recording consistent when memory runs out in the middle: recorded creations stay recorded, because caches
/// contain the objects; everything else is recorded completely or not at all.
///   Thread  as the command buffer.   Fails: never.
#pragma once

#include "backend/stream/CommandBuffer.h"

namespace filament_core::backend {

/// Records a command at the end of the scope, whatever happens in it.
template <class C>
struct InReserve {
    CommandBuffer& commands;
    C command;
    ~InReserve() { commands.recordInReserve(command); }
};

/// Drops the commands of the scope unless they are complete.
class AllOrNothing {
public:
    explicit AllOrNothing(CommandBuffer& commands) : mCommands(commands), mBefore(commands.mark()) {}
    ~AllOrNothing() {
        if (!mIsComplete) mCommands.rollBack(mBefore);
    }
    AllOrNothing(AllOrNothing const&) = delete;
    AllOrNothing& operator=(AllOrNothing const&) = delete;
    void complete() { mIsComplete = true; }

private:
    CommandBuffer& mCommands;
    const CommandBuffer::Mark mBefore;
    bool mIsComplete = false;
};

} // namespace filament_core::backend
