// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/LightShapes.h"

#include "base/math/Elementary.h"
#include "filament_core/engine/SceneImpl.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

namespace filament_core::engine {
namespace {

using scene::LightRecord;
using scene::LightShape;
using scene::ShownImage;

constexpr uint32_t kSides = 64; // of discs and tubes: at most 0.12 % of the radius inside of it

/// First indices and numbers of them, by Type from Rect on.
struct IndexRange {
    uint32_t first = 0, count = 0;
};
constexpr std::array kRanges{ IndexRange{ 0, 6 }, IndexRange{ 6, 3 * kSides },
                              IndexRange{ 6 + 3 * kSides, 6 * kSides } };

struct Mesh {
    std::vector<float3> points;
    std::vector<uint16_t> indices;
};

float2 onCircle(uint32_t corner) {
    const double turn = 2 * std::numbers::pi * corner / kSides;
    return { static_cast<float>(elementary::cos(turn)), static_cast<float>(elementary::sin(turn)) };
}

/// A square and a disc of radius 1 in the plane z = 0, which are seen from -z; and the side of a cylinder of radius 1
/// around x, from -1 to 1, seen from outside.
Mesh makeMesh() {
    Mesh mesh{ .points = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 }, { 0, 0, 0 } },
               .indices = { 0, 2, 1, 0, 3, 2 } };
    const auto disc = static_cast<uint32_t>(mesh.points.size()), tube = disc + kSides;
    for (uint32_t i = 0; i < kSides; ++i) mesh.points.emplace_back(onCircle(i), 0);
    for (uint32_t i = 0; i < kSides; ++i) {
        for (const float x : { -1.0f, 1.0f }) mesh.points.emplace_back(x, onCircle(i).x, onCircle(i).y);
    }
    const auto add = [&](std::array<uint32_t, 3> triangle) {
        for (const uint32_t corner : triangle) mesh.indices.push_back(static_cast<uint16_t>(corner));
    };
    for (uint32_t i = 0; i < kSides; ++i) add({ disc - 1, disc + (i + 1) % kSides, disc + i });
    for (uint32_t i = 0; i < kSides; ++i) {
        const uint32_t from = tube + 2 * i, to = tube + 2 * ((i + 1) % kSides);
        add({ from, to + 1, from + 1 });
        add({ from, to, to + 1 });
    }
    return mesh;
}

void makeMeshOnce(Engine::Impl& engine) {
    if (engine.lightShapeIndices) return;
    const Mesh mesh = makeMesh();
    if (!engine.lightShapeVertices) {
        engine.lightShapeVertices =
                engine.createVertexBuffer({ .vertexCount = static_cast<uint32_t>(mesh.points.size()),
                                            .stride = sizeof(float3),
                                            .attributes = { { Attribute::Position, VertexFormat::Float3, 0 } },
                                            .data = std::as_bytes(std::span(mesh.points)),
                                            .name = "light shapes" });
    }
    engine.lightShapeIndices = engine.createIndexBuffer({ .indexCount = static_cast<uint32_t>(mesh.indices.size()),
                                                          .data = std::as_bytes(std::span(mesh.indices)),
                                                          .name = "light shapes" });
}

size_t shapeKindOf(LightRecord const& light) {
    return static_cast<size_t>(light.type) - static_cast<size_t>(LightRecord::Type::Rect);
}

GeometryDesc geometryOf(Engine::Impl const& engine, LightRecord const& light) {
    const IndexRange range = kRanges[shapeKindOf(light)];
    const float depth = light.type == LightRecord::Type::Tube ? 1.0f : 0.0f;
    return { .vertices = engine.lightShapeVertices,
             .indices = engine.lightShapeIndices,
             .firstIndex = range.first,
             .indexCount = range.count,
             .bounds = Box{ double3(-1, -1, -depth), double3(1, 1, depth) } };
}

/// Columns: half edges or radii, and what points against the light's direction. As prepare/SelectLights.cpp.
double4x4 placeOf(LightRecord const& light) {
    const double3 side(light.sideWorld), direction(light.directionWorld);
    const double2 half(light.halfExtent);
    double3 x = glm::normalize(side), y(0, 1, 0), z(0, 0, 1);
    if (light.type == LightRecord::Type::Tube) {
        y = glm::normalize(glm::cross(std::abs(x.x) < 0.7 ? double3(1, 0, 0) : double3(0, 1, 0), x));
        z = glm::cross(x, y) * half.y;
    } else {
        const double3 up = glm::cross(side, direction);
        if (glm::length(up) > 0) y = glm::normalize(up);
        x = glm::cross(direction, y);
        z = -direction;
    }
    return { double4(x * half.x, 0), double4(y * half.y, 0), double4(z, 0), double4(light.positionWorld, 1) };
}

bool isDrawn(LightRecord const& light) {
    return light.channels != 0 && light.halfExtent.x > 0 && light.halfExtent.y > 0;
}

void place(scene::SceneData& data, LightShape& shape, LightRecord const& light) {
    scene::Renderables& renderables = data.renderables;
    const bool isHidden = (renderables.flags[renderables.index.at(shape.renderable)] & scene::kHidden) != 0;
    if (isHidden == isDrawn(light)) scene::setVisible(renderables, shape.renderable, isDrawn(light));
    const double4x4 place = placeOf(light);
    if (shape.worldFromShape == place) return;
    scene::setTransform(data, shape.renderable, place);
    shape.worldFromShape = place;
}

void setLuminance(Engine::Impl& engine, LightShape const& shape, LightRecord const& light) {
    const float3 nits = glm::min(light.color * light.intensity, float3(1e30f));
    const Result<void> written = engine.set(shape.instance, "luminance", nits);
    FILAMENT_ASSERT(written.ok(), "the engine's material has the parameter");
    engine.instances.get(shape.instance).raster.cullingDisabled = light.isTwoSided;
}

/// The levels of a table (assets/tables/LightImageTable.h) without their borders.
Texture textureOf(Engine::Impl& engine, std::vector<uint32_t> const& table) {
    const uint32_t width = table[0], height = table[1], levels = table[2] + 1;
    std::vector<uint32_t> texels;
    for (uint32_t level = 0; level < levels; ++level) {
        const uint32_t columns = std::max(width >> level, 1u), rows = std::max(height >> level, 1u);
        for (uint32_t row = 0; row < rows; ++row) {
            const auto first = table.begin() + table[shader::kImageHeaderWords + level] + (row + 1) * (columns + 2) + 1;
            texels.insert(texels.end(), first, first + columns);
        }
    }
    return engine.createTexture({ .format = Format::RGB9E5,
                                  .width = width,
                                  .height = height,
                                  .levels = levels,
                                  .pixels = std::as_bytes(std::span(texels)),
                                  .name = "image of a light" });
}

/// A texture that shows the light's image, which `before` may be; none for lights without one.
ShownImage shownImage(Engine::Impl& engine, LightRecord const& light, ShownImage const& before) {
    if (before.words == light.image) return before;
    if (before.texture) engine.destroy(before.texture);
    if (!light.image) return {};
    return { light.image, textureOf(engine, *light.image) };
}

/// Leaves its image.
void endShape(Engine::Impl& engine, scene::SceneData& data, LightShape const& shape) {
    scene::removeRenderable(data, shape.renderable);
    engine.destroy(shape.instance);
}

void destroyImage(Engine::Impl& engine, LightShape const& shape) {
    if (shape.shown.texture) engine.destroy(shape.shown.texture);
}

void beginShape(Scene::Impl& scene, Light light, ShownImage const& shown) {
    Engine::Impl& engine = scene.engine;
    scene::SceneData& data = scene.data;
    LightRecord const& record = data.lights.records[data.lights.index.at(light)];
    makeMeshOnce(engine);
    data.lightShapes.reserve(data.lightShapes.size() + 1);
    LightShape shape{ .light = light,
                      .renderable = {},
                      .instance = engine.createInstance(
                              engine.engineMaterial(shown.texture ? "light_shape_image" : "light_shape", {}), "light"),
                      .shown = shown,
                      .worldFromShape = placeOf(record) };
    if (shown.texture) {
        const Result<void> written = engine.set(shape.instance, "image", shown.texture, {});
        FILAMENT_ASSERT(written.ok(), "the engine's material has the parameter");
    }
    setLuminance(engine, shape, record);
    const GeometryDesc desc = geometryOf(engine, record);
    scene::MaterialInstance const& material = engine.instances.get(shape.instance);
    shape.renderable = scene::addRenderable(data, { .geometry = scene.geometryOf(desc, *material.material),
                                                    .material = &material,
                                                    .boundsMin = float3(desc.bounds->min),
                                                    .boundsMax = float3(desc.bounds->max),
                                                    .worldFromObject = shape.worldFromShape,
                                                    .castsShadows = false });
    place(data, shape, record);
    data.lightShapes.push_back(shape);
}

} // namespace

void updateLightShape(Scene::Impl& scene, Light light) {
    scene::SceneData& data = scene.data;
    LightRecord const& record = data.lights.records[data.lights.index.at(light)];
    const auto known = std::ranges::find(data.lightShapes, light, &LightShape::light);
    ShownImage shown;
    if (known != data.lightShapes.end()) { // its shape, sides, colour and image may have changed
        shown = known->shown;
        endShape(scene.engine, scene.changedUses(), *known);
        data.lightShapes.erase(known);
    }
    const bool isDrawn = record.isVisible && record.isArea();
    shown = shownImage(scene.engine, isDrawn ? record : LightRecord{}, shown);
    if (isDrawn) beginShape(scene, light, shown);
}

void placeLightShapes(Engine::Impl& engine, scene::SceneData& data) {
    const auto removed = std::ranges::partition(
            data.lightShapes, [&](LightShape const& shape) { return data.lights.index.contains(shape.light); });
    for (LightShape const& shape : removed) endShape(engine, data, shape), destroyImage(engine, shape);
    data.lightShapes.erase(removed.begin(), removed.end());
    for (LightShape& shape : data.lightShapes)
        place(data, shape, data.lights.records[data.lights.index.at(shape.light)]);
}

void destroyLightShapes(Engine::Impl& engine, scene::SceneData& data) {
    for (LightShape const& shape : data.lightShapes) engine.destroy(shape.instance), destroyImage(engine, shape);
    data.lightShapes.clear();
}

} // namespace filament_core::engine
