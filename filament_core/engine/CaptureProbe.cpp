// SPDX-License-Identifier: Apache-2.0
#include <filament_core/ProbeCapture.h>

#include "base/OutOfMemory.h"
#include "filament_core/assets/environment/CubeFaces.h"
#include "filament_core/assets/image/Ktx2Encoder.h"
#include "filament_core/engine/EngineImpl.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core {
namespace {

using engine::PublicCall;

Camera cameraOfFace(ReflectionProbeDesc const& place, assets::CubeFace const& face, Camera camera) {
    const double3x3 axes(place.worldFromBox);
    const double3 eye = place.centerWorld + axes * double3(place.captureInBoxMeters);
    camera.worldFromView = assets::worldFromFace(face, eye, axes);
    camera.lens = { .verticalFovDegrees = 90, .nearMeters = camera.lens.nearMeters };
    return camera;
}

Result<ProbeCapture> drawFaces(Engine& engine, Scene const& scene, ReflectionProbeDesc const& place,
                               ProbeCaptureOptions const& options) {
    View view = options.view;
    view.size = uint2(options.faceSize);
    view.viewport = {};
    const Owned<Texture> color = engine.own(engine.create(TextureDesc{ .format = Format::RGBA16F,
                                                                       .width = options.faceSize,
                                                                       .height = options.faceSize,
                                                                       .renderable = true,
                                                                       .name = "probe capture" }));
    if (!color.get()) return fail(ErrorCode::OutOfMemory, "capturing probe '{}': no texture for its faces", place.name);
    const Owned<RenderTarget> target = engine.own(engine.create(RenderTargetDesc{ .color = color }));
    Renderer renderer(engine);
    assets::Image cube{ .width = options.faceSize, .height = options.faceSize, .layers = 6, .format = Format::RGBA16F };
    std::vector<uint64_t> faces; // texels of four half floats
    for (assets::CubeFace const& face : assets::kCubeFaces) {
        view.camera = cameraOfFace(place, face, options.view.camera);
        renderer.render(scene, view, target);
        const Result<Image> drawn = renderer.waitPixels(renderer.readPixels(target));
        if (!drawn) return fail(drawn.error().code, "capturing probe '{}': {}", place.name, drawn.error().message);
        const std::span texels(reinterpret_cast<uint64_t const*>(drawn->pixels.data()), drawn->pixels.size() / 8);
        assets::appendFace(texels, options.faceSize, faces);
    }
    const std::span bytes = std::as_bytes(std::span(faces));
    cube.data.assign(bytes.begin(), bytes.end());
    return ProbeCapture{ assets::encodeKtx2(cube), 1 / view.camera.exposure.factor() };
}

} // namespace

Result<ProbeCapture> captureProbe(Engine& engine, Scene const& scene, ReflectionProbeDesc const& place,
                                  ProbeCaptureOptions const& options) {
    const PublicCall call(engine, "captureProbe(Engine, Scene, ReflectionProbeDesc)", place.name);
    FILAMENT_ASSERT(options.faceSize >= 16 && options.faceSize <= 4096,
                    "faces of a probe have 16 to 4096 pixels a side");
    return orOutOfMemory("reflection probe", place.name, [&] { return drawFaces(engine, scene, place, options); });
}

} // namespace filament_core
