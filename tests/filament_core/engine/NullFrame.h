// SPDX-License-Identifier: Apache-2.0
/// NullFrame: what one frame records without a device, for tests of what is not needed.
#pragma once

#include "tests/filament_core/engine/RenderFixture.h"

#include <string>

namespace filament_core::test {

struct NullFrame {
    uint64_t stream = 0; ///< hash of its commands
    std::string explanation;
};

/// `engine`: of Backend::Null with EngineOptions::hashFrames.
inline NullFrame nullFrame(Engine& engine, Scene const& scene, View const& view) {
    Renderer renderer(engine);
    const Owned<SwapChain> target = engine.own(engine.create(SwapChainDesc{ .size = view.size }));
    renderer.render(scene, view, target);
    engine.waitIdle();
    const std::vector<FrameTimings> timings = renderer.takeTimings();
    return { timings.empty() ? 0 : timings.back().streamHash, renderer.explain() };
}

} // namespace filament_core::test
