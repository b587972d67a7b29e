// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/ProbeCube.h"

#include "base/math/Half.h"
#include "filament_core/assets/environment/CubeFaces.h"
#include "filament_core/assets/image/Ktx2Encoder.h"

#include <algorithm>
#include <array>
#include <span>

namespace filament_core::reference {

Result<std::vector<std::byte>> traceProbe(TracedScene const& scene, ReferenceView view, uint32_t size,
                                          ReferenceSettings const& settings, jobs::JobSystem& jobs,
                                          Progress const& progress) {
    const double3 eye = view.camera.position();
    view.size = uint2(size);
    view.camera.lens = { .verticalFovDegrees = 90 };
    std::vector<float3> faces;
    for (assets::CubeFace const& face : assets::kCubeFaces) {
        view.camera.worldFromView = assets::worldFromFace(face, eye, double3x3(1.0));
        const Result<ReferenceImage> image = render(scene, view, settings, jobs, progress);
        if (!image) return image.error();
        assets::appendFace(std::span<const float3>(image->color), size, faces);
    }
    std::vector<std::array<uint16_t, 4>> texels;
    texels.reserve(faces.size());
    for (float3 const& color : faces) {
        const float3 held = glm::clamp(color, float3(0), float3(65504));
        texels.push_back({ halfFromFloat(held.x), halfFromFloat(held.y), halfFromFloat(held.z), halfFromFloat(1) });
    }
    const std::span bytes = std::as_bytes(std::span(texels));
    return assets::encodeKtx2({ .width = size,
                                .height = size,
                                .layers = 6,
                                .format = backend::Format::RGBA16F,
                                .data = { bytes.begin(), bytes.end() } });
}

} // namespace filament_core::reference
