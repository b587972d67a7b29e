// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/OcclusionImage.h"

#include <algorithm>
#include <cmath>

namespace filament_core::bake {
namespace {

constexpr double kUnknown = 1e-6; // length of a mean direction that says nothing

/// The open direction in the plane of the normal.
double2 bendOf(TextureFrame const& frame, TexelLight const& light) {
    const double length = glm::length(light.open);
    if (length < kUnknown) return double2(0.0);
    return double2(glm::dot(light.open, frame.right), glm::dot(light.open, frame.up)) / length;
}

/// Gives the texels between charts the mean of those of charts. Smaller levels than charts are padded for mix them in.
void fillBetween(Atlas const& atlas, std::vector<double4>& texels) {
    std::vector<bool> isInChart(texels.size(), false);
    double sum = 0;
    uint64_t count = 0;
    for (AtlasChart const& chart : atlas.charts) {
        for (uint32_t y = chart.place.y; y < chart.place.y + chart.size.y; ++y) {
            for (uint32_t x = chart.place.x; x < chart.place.x + chart.size.x; ++x, ++count) {
                const size_t index = size_t(y) * atlas.side + x;
                isInChart[index] = true;
                sum += texels[index].x;
            }
        }
    }
    const double4 mean(count > 0 ? sum / double(count) : 1, 0, 0, 0);
    for (size_t i = 0; i < texels.size(); ++i) {
        if (!isInChart[i]) texels[i] = mean;
    }
}

std::byte codeOf(double value) { return static_cast<std::byte>(std::lround(std::clamp(value, 0.0, 255.0))); }

} // namespace

TextureFrame frameOf(BakeSurface const& surface, AtlasSurface const& placed, AtlasTexel const& texel) {
    TextureFrame frame{ .normal = pointOf(surface, texel).normal };
    const size_t first = size_t(texel.triangle) * 3;
    const auto corner = [&](size_t i) { return surface.positions[surface.indices[first + i]]; };
    const auto uv = [&](size_t i) { return double2(placed.uvs[placed.indices[first + i]]); };
    const double3 e = corner(1) - corner(0), f = corner(2) - corner(0);
    const double2 a = uv(1) - uv(0), b = uv(2) - uv(0);
    const double side = a.x * b.y - b.x * a.y < 0 ? -1 : 1;
    const double3 alongU = (e * b.y - f * a.y) * side, againstV = (e * b.x - f * a.x) * side;
    const double3 right = alongU - frame.normal * glm::dot(alongU, frame.normal);
    const double length = glm::length(right);
    if (!(length > 0)) return frame; // no area: nothing shows it
    frame.right = right / length;
    frame.up = glm::cross(frame.normal, frame.right);
    if (glm::dot(frame.up, againstV) < 0) frame.up = -frame.up;
    return frame;
}

OcclusionImage makeOcclusionImage(std::span<const BakeSurface> surfaces, Atlas const& atlas,
                                  std::span<const AtlasTexel> texels, std::span<const TexelLight> lights) {
    std::vector<TexelLight> stored(lights.begin(), lights.begin() + static_cast<std::ptrdiff_t>(texels.size()));
    for (size_t i = 0; i < texels.size(); ++i) {
        const uint32_t surface = atlas.charts[texels[i].chart].surface;
        const TextureFrame frame = frameOf(surfaces[surface], atlas.surfaces[surface], texels[i]);
        stored[i].irradiance = double3(lights[i].irradiance.x, bendOf(frame, lights[i]));
    }
    OcclusionImage image{ .visible = makeImage(atlas, texels, stored) };
    image.visible.intensity = 1;
    image.visible.smaller.clear();
    fillBetween(atlas, image.visible.texels);
    image.rgba8.reserve(image.visible.texels.size() * 4);
    for (double4& texel : image.visible.texels) {
        const std::byte codes[] = { codeOf(texel.x * 255), codeOf(texel.y * 127 + 128), codeOf(texel.z * 127 + 128),
                                    std::byte{ 255 } };
        image.rgba8.insert(image.rgba8.end(), std::begin(codes), std::end(codes));
        texel = double4(std::to_integer<int>(codes[0]) / 255.0);
    }
    return image;
}

} // namespace filament_core::bake
