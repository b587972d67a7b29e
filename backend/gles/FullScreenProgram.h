// SPDX-License-Identifier: Apache-2.0
/// FullScreenProgram: a fragment shader of the driver's own, run for every pixel of a rectangle.
///   Thread  the driver thread, outside of the draws of a pass; leaves its own bindings in ContextState, which knows.
///   Memory  one program and an empty vertex array, made at the first use.
///   Fails   draw() says no where the program cannot be linked, which is reported.
#pragma once

#include "backend/gles/Device.h"

#include <string_view>

namespace filament_core::backend::gles {

class FullScreenProgram {
public:
    /// `fragment` and `name` live as long as this object. The shader reads its texture at unit kUnit.
    FullScreenProgram(Device& device, std::string_view fragment, std::string_view name)
            : mDevice(device), mFragment(fragment), mName(name) {}
    ~FullScreenProgram();
    FullScreenProgram(FullScreenProgram const&) = delete;
    FullScreenProgram& operator=(FullScreenProgram const&) = delete;

    static constexpr uint32_t kUnit = 0;

    /// Without blending and culling; depth as `depthStencil` says.
    bool draw(GLuint framebuffer, Rect const& rect, GLenum target, GLuint texture,
              DepthStencilState const& depthStencil);

private:
    bool prepare();

    Device& mDevice;
    std::string_view mFragment, mName;
    GLuint mProgram = 0, mVertexArray = 0;
};

} // namespace filament_core::backend::gles
