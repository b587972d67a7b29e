// SPDX-License-Identifier: Apache-2.0
/// Solids that section planes cut, and the rays through their pictures.
#pragma once

#include "tests/filament_core/engine/ShadowStage.h"

#include <filament_core/Primitives.h>
#include <filament_core/RenderAovs.h>

#include <cmath>
#include <cstring>

namespace filament_core {

inline constexpr uint2 kSectionSize(40, 32);

inline std::string sectioned(std::string const& properties, std::string const& color) {
    return "material { name : sectioned, shadingModel : lit, sectionPlanes : true" + properties + R"( }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = )" +
           color + R"(;
    material.roughness = 0.25;
    material.metallic = 0.75;
} })";
}
inline const std::string kSectioned = sectioned("", "isSectionCap() ? vec3(0.8, 0.4, 0.2) : vec3(0.3, 0.5, 0.7)");

/// A solid of the scene that planes may cut.
class SolidMesh {
public:
    SolidMesh(Engine& engine, Mesh const& mesh)
            : mVertices(engine.own(engine.create(mesh.vertexBuffer()))),
              mIndices(engine.own(engine.create(mesh.indexBuffer()))), mBounds(mesh.bounds()) {}

    Renderable add(Scene& scene, MaterialInstance material, double4x4 const& world) const {
        return scene.add({ .vertices = mVertices,
                           .indices = mIndices,
                           .material = material,
                           .bounds = mBounds,
                           .worldFromObject = world });
    }

private:
    Owned<VertexBuffer> mVertices;
    Owned<IndexBuffer> mIndices;
    Box mBounds;
};

struct SectionStage {
    Engine engine;
    SolidMesh box{ engine, *makeBox({ .size = float3(2) }) };
    Owned<Material> material;
    Owned<MaterialInstance> instance;
    View view{ .camera = Camera::lookAt({ 2.2, 2.9, 4.1 }, { 0.1, 0, 0 }, { .verticalFovDegrees = 42 }),
               .size = kSectionSize };

    explicit SectionStage(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              material(test::loadMaterial(engine, kSectioned)), instance(engine.own(engine.createInstance(material))) {}
    ~SectionStage() { test::expectNoErrors(engine); }
};

inline float4 aovNumberAt(Image const& image, uint2 pixel) {
    float4 number;
    std::memcpy(&number, image.pixels.data() + (size_t{ pixel.y } * image.width + pixel.x) * sizeof(number),
                sizeof(number));
    return number;
}

struct SectionRay {
    double3 origin, along; ///< one metre along the view for each of `along`
};
inline SectionRay sectionRay(View const& view, double2 at) {
    const double3x3 axes(view.camera.worldFromView);
    const double2 place = at / double2(view.size) * 2.0 - 1.0;
    const double4x4 clip(view.camera.clipFromView(static_cast<float>(view.size.x) / static_cast<float>(view.size.y)));
    const double3 across(place.x / clip[0].x, -place.y / std::abs(clip[1].y), 0);
    if (clip[3].w != 0) return { view.camera.position() + axes * across, axes * double3(0, 0, -1) };
    return { view.camera.position(), axes * (across + double3(0, 0, -1)) };
}

} // namespace filament_core
