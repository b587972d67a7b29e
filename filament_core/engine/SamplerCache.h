// SPDX-License-Identifier: Apache-2.0
/// SamplerCache: one device object for all equal samplers. Samplers live as long as the engine.
#pragma once

#include "backend/stream/CommandStream.h"

#include <filament_core/Sampler.h>

#include <utility>
#include <vector>

namespace filament_core::engine {

inline backend::SamplerDesc descOf(Sampler const& sampler) {
    return { .magFilter = sampler.magFilter,
             .minFilter = sampler.minFilter,
             .mipFilter = sampler.mipFilter,
             .wrapU = sampler.wrapU,
             .wrapV = sampler.wrapV,
             .anisotropy = sampler.anisotropy };
}

class SamplerCache {
public:
    explicit SamplerCache(backend::CommandStream& stream) : mStream(stream) {}

    backend::SamplerHandle get(backend::SamplerDesc const& sampler, backend::CommandBuffer& commands) {
        for (auto const& [known, handle] : mSamplers) {
            if (known == sampler) return handle;
        }
        mSamplers.emplace_back(sampler, backend::SamplerHandle{});
        try {
            backend::NewHandle handle(mStream, mStream.allocateSampler());
            commands.record(backend::CmdCreateSampler{ handle, sampler });
            return mSamplers.back().second = handle.keep();
        } catch (...) {
            mSamplers.pop_back(); // a cache contains exactly what is recorded
            throw;
        }
    }

    void destroyAll(backend::CommandBuffer& commands) {
        for (auto const& [known, handle] : mSamplers) mStream.destroy(commands, handle);
        mSamplers.clear();
    }

private:
    backend::CommandStream& mStream;
    std::vector<std::pair<backend::SamplerDesc, backend::SamplerHandle>> mSamplers; // a handful: linear search
};

} // namespace filament_core::engine
