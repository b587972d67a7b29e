// SPDX-License-Identifier: Apache-2.0
#include "toolkit/showcase/SceneBuilder.h"

#include "base/Assert.h"

#include <cmath>
#include <iterator>
#include <utility>

namespace filament_core::showcase {
namespace {

/// A frame whose +Z is `z`, as columns.
double4x4 frameFromZ(double3 z) {
    z = normalize(z);
    const double3 helper = std::abs(z.y) < 0.9 ? double3(0, 1, 0) : double3(1, 0, 0);
    const double3 x = normalize(cross(helper, z)), y = cross(z, x);
    return { double4(x, 0), double4(y, 0), double4(z, 0), double4(0, 0, 0, 1) };
}

} // namespace

SceneBuilder::SceneBuilder(std::string name) { mScene.name = std::move(name); }

Result<TextureSetImages> SceneBuilder::addPictures(std::string const& name, TextureSet const& set) {
    TextureSetImages images;
    const std::pair<Picture const*, uint32_t*> all[] = { { &set.color, &images.color },
                                                         { &set.normal, &images.normal },
                                                         { &set.surface, &images.surface },
                                                         { &set.emission, &images.emission } };
    constexpr const char* kSuffixes[] = { " color", " normal", " surface", " emission" };
    for (size_t i = 0; i < std::size(all); ++i) {
        Picture const& picture = *all[i].first;
        if (picture.pixels.empty()) continue;
        Result<assets::GlbImage> image =
                assets::glbImageFromPixels(name + kSuffixes[i], picture.size, picture.size, picture.pixels);
        if (!image) return image.error();
        *all[i].second = static_cast<uint32_t>(mScene.images.size());
        mScene.images.push_back(std::move(*image));
    }
    return images;
}

uint32_t SceneBuilder::add(assets::MaterialData material) {
    mScene.materials.push_back(std::move(material));
    return static_cast<uint32_t>(mScene.materials.size() - 1);
}

void SceneBuilder::place(std::string name, Shape const& shape, uint32_t material, float3 position,
                         float rotationRadians) {
    FILAMENT_ASSERT(material < mScene.materials.size(), "materials are added before the shapes that use them");
    assets::GlbPrimitive primitive{ .positions = shape.positions,
                                    .normals = shape.normals,
                                    .colors = shape.colors,
                                    .uvs = shape.uvs,
                                    .indices = shape.indices,
                                    .material = material };
    const double c = std::cos(rotationRadians), s = std::sin(rotationRadians);
    const double4x4 parentFromNode{ double4(c, 0, -s, 0), double4(0, 1, 0, 0), double4(s, 0, c, 0),
                                    double4(double3(position), 1) };
    const uint32_t mesh = static_cast<uint32_t>(mScene.meshes.size());
    mScene.meshes.push_back({ .name = name, .primitives = { std::move(primitive) } });
    mScene.nodes.push_back({ .name = std::move(name), .parentFromNode = parentFromNode, .mesh = mesh });
}

void SceneBuilder::addSun(float3 towardsLight, float3 color, float lux) {
    const uint32_t light = static_cast<uint32_t>(mScene.lights.size());
    mScene.lights.push_back(
            { .name = "sun", .type = assets::LightType::Directional, .color = color, .intensity = lux });
    mScene.nodes.push_back({ .name = "sun", .parentFromNode = frameFromZ(double3(towardsLight)), .light = light });
}

assets::TextureRef textured(uint32_t image) {
    return { .image = image,
             .sampler = { .magFilter = Filter::Linear,
                          .minFilter = Filter::Linear,
                          .mipFilter = MipFilter::Linear,
                          .wrapU = WrapMode::Repeat,
                          .wrapV = WrapMode::Repeat } };
}

} // namespace filament_core::showcase
