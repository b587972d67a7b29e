// SPDX-License-Identifier: Apache-2.0
/// Samplers: GL sampler objects by handle.
///   Thread  the driver thread.
///   Limits  anisotropy is clamped to DeviceLimits::maxAnisotropy.
///   Fails   never.
#pragma once

#include "backend/api/Slots.h"
#include "backend/gles/Device.h"

namespace filament_core::backend::gles {

class Samplers {
public:
    explicit Samplers(Device& device) : mDevice(device) {}
    ~Samplers();
    Samplers(Samplers const&) = delete;
    Samplers& operator=(Samplers const&) = delete;

    void create(SamplerHandle handle, SamplerDesc const& desc);
    void destroy(SamplerHandle handle);
    /// 0 if it does not exist.
    GLuint find(SamplerHandle handle) const;

private:
    Device& mDevice;
    Slots<SamplerHandle, GLuint> mSamplers;
};

} // namespace filament_core::backend::gles
