// SPDX-License-Identifier: Apache-2.0
// The frames of a scene file: what moves, and what lies over the last one.
#include <filament_core/BuildScene.h>

#include "base/OutOfMemory.h"

#include <filament_core/Animator.h>
#include <filament_core/ModelCopy.h>
#include <filament_core/TextureStreaming.h>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>

namespace filament_core {
namespace {

double4x4 movedBack(double3 const& metersPerFrame, uint32_t frames) {
    return glm::translate(double4x4(1.0), metersPerFrame * -static_cast<double>(frames));
}

void placeCopies(BuiltScene& built, uint32_t framesBack) {
    const double seconds = -built.contents.secondsPerFrame * framesBack;
    for (size_t i = 0; i < built.copies.size(); ++i) {
        SceneFileModel const& model = built.contents.models[i];
        for (size_t k = 0; k < built.copies[i].size(); ++k) {
            const Node root = built.copies[i][k];
            if (model.copies[k].metersPerFrame != double3(0.0))
                built.scene.setTransform(root,
                                         movedBack(model.copies[k].metersPerFrame, framesBack) * built.places[i][k]);
            if (model.animationSeconds && built.contents.secondsPerFrame != 0)
                Animator(built.models[i], built.scene, root).apply(model.animation, *model.animationSeconds + seconds);
        }
    }
}

} // namespace

void setFramesBack(BuiltScene& built, uint32_t framesBack) {
    placeCopies(built, framesBack);
    View& view = built.view;
    view.camera.worldFromView =
            movedBack(built.contents.camera.metersPerFrame, framesBack) * built.lastCamera.worldFromView;
    view.timeSeconds = built.contents.view.timeSeconds - built.contents.secondsPerFrame * framesBack;
    for (std::vector<Node> const& copies : built.copies)
        for (const Node copy : copies) ModelCopy::of(built.scene, copy)->chooseLevels(view);
}

void drawFrames(Engine& engine, Renderer& renderer, BuiltScene& built, SwapChain target) {
    const uint32_t frames = std::max(built.contents.frames, 1u);
    if (textureResidency(engine).textures > 0) { // streamed textures come with later frames
        setFramesBack(built, frames - 1);
        Renderer first(engine); // which leaves no history
        do first.render(built.scene, built.view, target);
        while (waitForTextures(engine));
    }
    for (uint32_t back = frames; back-- > 0;) {
        setFramesBack(built, back);
        renderer.render(built.scene, built.view, target);
    }
    for (View const& overlay : built.overlays) {
        Renderer own(engine); // it is another camera's
        own.render(built.scene, overlay, target);
    }
}

Result<Image> renderFrames(Engine& engine, BuiltScene& built) {
    return orOutOfMemory("scene file", {}, [&]() -> Result<Image> {
        uint2 const& size = built.contents.target.x > 0 ? built.contents.target : built.view.size;
        const Owned<SwapChain> target = engine.own(
                engine.create(SwapChainDesc{ .size = size,
                                             .imageCount = 1,
                                             .format = built.contents.isLinear ? Format::RGBA16F : Format::RGBA8,
                                             .name = "scene file" }));
        Renderer renderer(engine);
        drawFrames(engine, renderer, built, target);
        return renderer.waitPixels(renderer.readPixels(target));
    });
}

} // namespace filament_core
