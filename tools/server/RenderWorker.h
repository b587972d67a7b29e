// SPDX-License-Identifier: Apache-2.0
/// RenderWorker: a process that draws jobs of a spool, one after the other.
///   Life    until its parent ends, or by a signal. An engine for each API, created for its first job, and again after
///           its device was lost.
///   Fails   what is wrong with a job is the job's outcome. Only a spool that cannot be used ends the process.
#pragma once

#include "tools/server/RenderRequest.h"
#include "tools/server/Spool.h"

#include <cstddef>
#include <map>
#include <vector>

namespace filament_core::server {

class RenderWorker {
public:
    RenderWorker(Spool spool, RequestLimits limits) : mSpool(std::move(spool)), mLimits(std::move(limits)) {}

    Result<void> run();
    /// Draws one job and finishes it.
    Result<void> handle(ClaimedJob const& job);

private:
    Result<Engine*> engineOf(Backend api);
    /// Writes the image to `file`.
    Result<void> draw(RenderRequest const& request, std::filesystem::path const& file);

    Spool mSpool;
    RequestLimits mLimits;
    std::map<Backend, Engine> mEngines;
};

} // namespace filament_core::server
