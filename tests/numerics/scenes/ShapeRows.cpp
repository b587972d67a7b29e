// SPDX-License-Identifier: Apache-2.0
// Transforms and vertices without an inverse, a normal or an area; coincident surfaces.
#include "tests/numerics/scenes/Exact.h"
#include "tests/numerics/scenes/HardCase.h"

#include "tests/scenes/Sphere.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

namespace filament_core::hard {
namespace {

void light(Stage& stage, double3 eye = { 0.5, 0.8, 3 }, float nearMeters = 0.01f) {
    stage.scene.add(SunLight{ .directionWorld = { -0.4f, -0.7f, -1 } });
    stage.addConstantSky(Lux{ 8'000 });
    stage.view.camera = Camera::lookAt(eye, { 0, 0, 0 }, { .verticalFovDegrees = 50, .nearMeters = nearMeters });
}

// ------------------------------------------------------------------------------------------- scales

/// The unit sphere scaled component by component, with the normals of an ellipsoid: gradients of x^2/a^2 + ...
Mesh ellipsoidMesh(double3 axes) {
    Mesh mesh = transformed(sphereMesh(), float3(axes));
    for (Vertex& vertex : mesh.vertices) {
        const double3 normal = glm::normalize(double3(vertex.position) / (axes * axes));
        double3 tangent = glm::cross(double3(0, 1, 0), normal);
        tangent = glm::length(tangent) > 1e-6 ? glm::normalize(tangent) : double3(1, 0, 0);
        vertex.tangents =
                scenes::quaternionFromFrame(float3(tangent), float3(glm::cross(normal, tangent)), float3(normal));
        if (vertex.tangents.w < 0) vertex.tangents = -vertex.tangents;
    }
    return mesh;
}

HardCase stretched(double3 axes) {
    const double far = 2.5 * std::max({ axes.x, axes.y, axes.z });
    const double3 eye = double3(0.4, 0.9, 0.7) * far;
    return { .name = fmt::format("A sphere stretched by {:g} {:g} {:g} is the ellipsoid", axes.x, axes.y, axes.z),
             .scene =
                     [=](Stage& stage) {
                         stage.add(sphereMesh(), scaling(axes), { .roughness = 0.8f });
                         light(stage, eye, static_cast<float>(0.01 * far));
                     },
             .twin =
                     [=](Stage& stage) {
                         stage.add(ellipsoidMesh(axes), double4x4(1.0), { .roughness = 0.8f });
                         light(stage, eye, static_cast<float>(0.01 * far));
                     } };
}

// A scale that the transform undoes must not matter: cofactors of such scales are 1e-24 to 1e24.
HardCase rescaled(double scale) {
    return { .name = fmt::format("A sphere of radius {:.0e} shrunk to 1 is the unit sphere", scale),
             .scene =
                     [=](Stage& stage) {
                         stage.add(transformed(sphereMesh(), float3(static_cast<float>(scale))),
                                   scaling(double3(1 / scale)), { .bumpy = true });
                         light(stage);
                     },
             .twin =
                     [](Stage& stage) {
                         stage.add(sphereMesh(), double4x4(1.0), { .bumpy = true });
                         light(stage);
                     } };
}

void mirrorable(Stage& stage, double side) {
    const double4x4 mirror = scaling({ side, 1, 1 });
    stage.add(sphereMesh(), mirror * translation({ -0.6, 0, 0 }),
              { .baseColor = { 0.8f, 0.2f, 0.1f, 1 }, .bumpy = true });
    stage.add(sphereMesh(), mirror * translation({ 0.9, 0.2, 0.2 }) * scaling(double3(0.7)), { .metallic = 1 });
    stage.scene.add(SunLight{ .directionWorld = { static_cast<float>(-0.4 * side), -0.7f, -1 } });
    stage.addConstantSky(Lux{ 8'000 });
    stage.view.camera = Camera::lookAt({ 0, 0.6, 3.5 }, { 0, 0, 0 });
}

HardCase flattened() {
    const Look look{ .roughness = 0.9f };
    const SunLight sun{ .directionWorld = { 0.3f, -0.2f, -1 } };
    const auto place = [](View& view) {
        view.camera = Camera::lookAt({ 0.3, 0.5, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 });
    };
    return { .name = "A sphere flattened to nothing is lit as the disc that it is",
             .scene =
                     [=](Stage& stage) {
                         place(stage.view);
                         stage.add(sphereMesh(), scaling({ 1, 1, 0 }), look);
                         stage.scene.add(sun);
                     },
             .holds =
                     [=](Picture const& picture) {
                         View view{ .size = { 64, 64 } };
                         place(view);
                         // The rim's own normals lie in the plane: when flattened, they have no direction.
                         expectSunOnWall(picture, view, look, sun, 0.01, 0.95);
                         EXPECT_GT(picture.coveredCount(), 700u);
                     } };
}

HardCase vanished(std::string name, double4x4 const& worldFromObject) {
    return { .name = std::move(name),
             .scene =
                     [=](Stage& stage) {
                         stage.add(sphereMesh(), worldFromObject);
                         light(stage);
                     },
             .holds = [](Picture const& picture) { EXPECT_EQ(picture.coveredCount(), 0u); } };
}

std::vector<HardCase> transformRows() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    std::vector<HardCase> rows{
        { .name = "A mirrored scene is the mirror image",
          .scene = [](Stage& stage) { mirrorable(stage, -1); },
          .twin = [](Stage& stage) { mirrorable(stage, 1); },
          .mirrored = true },
        flattened(),
        vanished("A sphere squeezed to a line has no pixels", scaling({ 1, 0, 0 })),
        vanished("A sphere squeezed to a point has no pixels", scaling({ 0, 0, 0 })),
        vanished("A sphere of infinite size has no pixels", scaling({ kInfinity, 1, 1 })),
        vanished("A sphere nowhere has no pixels", translation({ kNaN, 0, 0 })),
    };
    for (double3 axes :
         { double3(3, 0.01, 0.5), double3(1e3, 1e-3, 1e3), double3(1e-3, 2e-3, 5e-4), double3(1, 1e-6, 1) })
        rows.push_back(stretched(axes));
    for (double scale : { 1e-6, 1e-3, 1e3, 1e6 }) rows.push_back(rescaled(scale));
    return rows;
}

// ---------------------------------------------------------------------------------------- attributes

using Damage = void (*)(Mesh&);

HardCase damaged(std::string name, Damage damage, SceneBuilder twin, std::function<void(Picture const&)> holds) {
    return { .name = std::move(name),
             .scene =
                     [=](Stage& stage) {
                         Mesh mesh = quadMesh();
                         damage(mesh);
                         stage.add(mesh, double4x4(1.0), { .bumpy = true });
                         light(stage);
                     },
             .twin = std::move(twin),
             .holds = std::move(holds) };
}

void soundQuad(Stage& stage) {
    stage.add(quadMesh(), double4x4(1.0), { .bumpy = true });
    light(stage);
}

// The quad covers 1200 pixels; none may be black, whatever its frame.
void expectNoBlackTile(Picture const& picture) {
    uint32_t black = 0;
    forEachCovered(picture, [&](uint32_t, uint32_t, float4 color) { black += color.x < 0.01f; });
    EXPECT_EQ(black, 0u);
    EXPECT_GT(picture.coveredCount(), 1000u);
}

std::vector<HardCase> attributeRows() {
    const Damage zeroFrames = [](Mesh& mesh) {
        for (Vertex& vertex : mesh.vertices) vertex.tangents = float4(0);
    };
    const Damage oppositeNormals = [](Mesh& mesh) {
        for (size_t i = 0; i < 2; ++i) mesh.vertices[i].tangents = { 1, 0, 0, 1e-5f }; // half a turn around x: -z
    };
    const Damage sameUv = [](Mesh& mesh) {
        for (Vertex& vertex : mesh.vertices) vertex.uv = float2(0.25f);
    };
    const Damage hugeUv = [](Mesh& mesh) {
        for (Vertex& vertex : mesh.vertices) vertex.uv *= 1e30f;
    };
    const Damage slivers = [](Mesh& mesh) {
        mesh.indices.insert(mesh.indices.end(), { 0, 0, 0, 0, 1, 1, 2, 2, 0, 3, 3, 3 });
    };
    return {
        damaged("Frames of zeros are the frame along z", zeroFrames, soundQuad, {}),
        damaged("Triangles without area change nothing", slivers, soundQuad, {}),
        damaged("Normals that interpolate through zero stay finite", oppositeNormals, {}, {}),
        damaged("One texture coordinate everywhere leaves no black tile", sameUv, {}, expectNoBlackTile),
        damaged("Texture coordinates of 1e30 leave no black tile", hugeUv, {}, expectNoBlackTile),
    };
}

// ------------------------------------------------------------------------------------------- decals

HardCase coplanar(std::string name, std::vector<Look> looks, bool redWins) {
    return { .name = std::move(name),
             .scene =
                     [=](Stage& stage) {
                         for (Look const& look : looks) stage.add(quadMesh(), translation({ 0.1, 0.2, 0.3 }), look);
                         light(stage, { 1.5, 1.1, 2 });
                     },
             .holds =
                     [=](Picture const& picture) {
                         uint32_t red = 0, blue = 0;
                         forEachCovered(picture,
                                        [&](uint32_t, uint32_t, float4 color) { ++(color.x > color.z ? red : blue); });
                         EXPECT_EQ(redWins ? blue : red, 0u) << "pixels of the other surface show";
                         EXPECT_GT(red + blue, 500u);
                     } };
}

std::vector<HardCase> decalRows() {
    Look glassRed = kRed;
    glassRed.blended = true;
    return {
        coplanar("Of two surfaces in one place the one made last shows, red", { kBlue, kRed }, true),
        coplanar("Of two surfaces in one place the one made last shows, blue", { kRed, kBlue }, false),
        coplanar("A blended decal shows on its surface, made first", { glassRed, kBlue }, true),
        coplanar("A blended decal shows on its surface, made last", { kBlue, glassRed }, true),
    };
}

} // namespace

std::vector<HardCase> shapeRows() {
    std::vector<HardCase> rows = transformRows();
    for (auto const& part : { attributeRows(), decalRows() }) rows.insert(rows.end(), part.begin(), part.end());
    return rows;
}

} // namespace filament_core::hard
