// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Sampler.h"

#include <algorithm>

namespace filament_core::backend::gles {

Samplers::~Samplers() {
    mSamplers.forEach([this](GLuint& sampler) { mDevice.gl.DeleteSamplers(1, &sampler); });
}

void Samplers::create(SamplerHandle handle, SamplerDesc const& desc) {
    Api const& gl = mDevice.gl;
    GLuint sampler = 0;
    gl.GenSamplers(1, &sampler);
    const auto set = [&](GLenum what, GLenum value) { gl.SamplerParameteri(sampler, what, static_cast<GLint>(value)); };
    set(GL_TEXTURE_MAG_FILTER, glFilter(desc.magFilter));
    set(GL_TEXTURE_MIN_FILTER, glMinFilter(desc));
    set(GL_TEXTURE_WRAP_S, glWrap(desc.wrapU));
    set(GL_TEXTURE_WRAP_T, glWrap(desc.wrapV));
    set(GL_TEXTURE_WRAP_R, glWrap(desc.wrapW));
    if (desc.compare != CompareOp::None) {
        set(GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        set(GL_TEXTURE_COMPARE_FUNC, glCompare(desc.compare));
    }
    if (desc.anisotropy > 1 && mDevice.quirks.anisotropy) {
        const float wanted = std::min(static_cast<float>(desc.anisotropy), mDevice.info.limits.maxAnisotropy);
        gl.SamplerParameterf(sampler, GL_TEXTURE_MAX_ANISOTROPY_EXT, wanted);
    }
    mSamplers.put(handle, std::make_unique<GLuint>(sampler));
}

void Samplers::destroy(SamplerHandle handle) {
    const std::unique_ptr<GLuint> sampler = mSamplers.take(handle);
    if (!sampler) return;
    mDevice.state.forgetSampler(*sampler);
    mDevice.gl.DeleteSamplers(1, sampler.get());
}

GLuint Samplers::find(SamplerHandle handle) const {
    GLuint const* sampler = mSamplers.find(handle);
    return sampler ? *sampler : 0;
}

} // namespace filament_core::backend::gles
