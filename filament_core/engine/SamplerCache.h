// SPDX-License-Identifier: Apache-2.0
/// SamplerCache: one device object for all equal samplers. Samplers live as long as the engine.
#pragma once

#include "backend/stream/CommandStream.h"

#include <utility>
#include <vector>

namespace filament::engine {

class SamplerCache {
public:
    explicit SamplerCache(backend::CommandStream& stream) : mStream(stream) {}

    backend::SamplerHandle get(Sampler const& sampler, backend::CommandBuffer& commands) {
        for (auto const& [known, handle] : mSamplers) {
            if (known == sampler) return handle;
        }
        const backend::SamplerHandle handle = mStream.allocateSampler();
        commands.record(backend::CmdCreateSampler{ handle, sampler });
        mSamplers.emplace_back(sampler, handle);
        return handle;
    }

    void destroyAll(backend::CommandBuffer& commands) {
        for (auto const& [known, handle] : mSamplers) {
            commands.record(backend::CmdDestroySampler{ handle });
            mStream.free(handle);
        }
        mSamplers.clear();
    }

private:
    backend::CommandStream& mStream;
    std::vector<std::pair<Sampler, backend::SamplerHandle>> mSamplers; // a handful: linear search
};

} // namespace filament::engine
