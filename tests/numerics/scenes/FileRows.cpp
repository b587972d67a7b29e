// SPDX-License-Identifier: Apache-2.0
// glTF files with degenerate attributes: each is drawn without inf and NaN. Broken files (wrong counts, indices out of
// range) are refused: tests/filament_core/assets/gltf/GltfBrokenFileTest.cpp.
#include "tests/filament_core/assets/gltf/GltfTestFile.h"
#include "tests/numerics/scenes/HardCase.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace filament_core::hard {
namespace {

using assets::test::kFloat;
using assets::test::TestFile;

/// A square at z = 0 that fills much of the image, before it is modified.
struct Square {
    std::vector<float> positions{ -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0 };
    std::vector<float> normals{ 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 };
    std::vector<float> tangents{ 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1 };
    std::vector<float> uvs{ 0, 1, 1, 1, 1, 0, 0, 0 };
    std::vector<float> colors{ 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1 };
    std::vector<uint16_t> indices{ 0, 1, 2, 0, 2, 3 };

    assets::test::Bytes glb() const {
        TestFile file;
        file.positions(positions);
        file.normals(normals);
        file.attribute("TANGENT", tangents, kFloat, "VEC4", 4);
        file.attribute("TEXCOORD_0", uvs, kFloat, "VEC2", 2);
        file.attribute("COLOR_0", colors, kFloat, "VEC4", 4);
        file.indices(indices);
        return file.glb();
    }
};

void show(Stage& stage, Square const& square) {
    stage.addFile(square.glb());
    stage.scene.add(SunLight{ .directionWorld = { -0.4f, -0.7f, -1 } });
    stage.addConstantSky(Lux{ 8'000 });
    stage.view.camera = Camera::lookAt({ 0.5, 0.8, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 });
}

HardCase file(std::string name, void (*damage)(Square&), bool looksSound = false) {
    HardCase row{ .name = "A glTF file with " + std::move(name), .scene = [damage](Stage& stage) {
                     Square square;
                     damage(square);
                     show(stage, square);
                 } };
    if (looksSound) row.twin = [](Stage& stage) { show(stage, Square{}); };
    return row;
}

void fill(std::vector<float>& values, float value) { values.assign(values.size(), value); }

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
constexpr float kHuge = 3e38f, kTiny = 1e-40f; // nearly beyond float; denormal

std::vector<HardCase> normalRows() {
    return {
        file("normals of length zero is drawn", [](Square& square) { fill(square.normals, 0); }),
        file("normals of NaN is drawn", [](Square& square) { fill(square.normals, kNaN); }),
        file("normals of a denormal length is drawn", [](Square& square) { fill(square.normals, kTiny); }),
        file("normals whose square overflows is drawn", [](Square& square) { fill(square.normals, kHuge); }),
        file(
                "normals of length 1000 looks like one with unit normals",
                [](Square& square) {
                    for (size_t i = 2; i < square.normals.size(); i += 3) square.normals[i] = 1000;
                },
                true),
        file("tangents of length zero is drawn", [](Square& square) { fill(square.tangents, 0); }),
        file("tangents of NaN is drawn", [](Square& square) { fill(square.tangents, kNaN); }),
        file("tangents along its normals is drawn",
             [](Square& square) {
                 for (size_t i = 0; i < square.tangents.size(); i += 4) {
                     square.tangents[i] = 0;
                     square.tangents[i + 2] = 1;
                 }
             }),
    };
}

std::vector<HardCase> positionRows() {
    return {
        file("positions of NaN is drawn without them", [](Square& square) { square.positions[3] = kNaN; }),
        file("infinite positions is drawn without them", [](Square& square) { square.positions[4] = kInfinity; }),
        file("positions near the end of float is drawn", [](Square& square) { square.positions[6] = kHuge; }),
        file("positions all in one place has no pixels", [](Square& square) { fill(square.positions, 0); }),
        file("denormal positions has no pixels", [](Square& square) { fill(square.positions, kTiny); }),
        file(
                "triangles of one and two corners looks like one without them",
                [](Square& square) {
                    square.indices.insert(square.indices.end(), { 0, 0, 0, 1, 1, 2, 3, 2, 2 });
                },
                true),
        file("texture coordinates of NaN is drawn", [](Square& square) { fill(square.uvs, kNaN); }),
        file("texture coordinates near the end of float is drawn", [](Square& square) { fill(square.uvs, kHuge); }),
        file("colours of NaN is drawn", [](Square& square) { fill(square.colors, kNaN); }),
        file("colours near the end of float is drawn", [](Square& square) { fill(square.colors, kHuge); }),
        file("negative colours is drawn", [](Square& square) { fill(square.colors, -1); }),
    };
}

// ------------------------------------------------------------------------------- surfaces in one place

/// [-1, 1]^2 divided into triangles around a point: two such meshes share only the corners.
Mesh fanMesh(float2 center) {
    Mesh mesh = quadMesh();
    mesh.vertices.push_back({ .position = float3(center, 0), .uv = center });
    mesh.indices = { 4, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0 };
    return mesh;
}

void layer(Stage& stage, std::vector<float2> const& centers, double tilt) {
    constexpr float4 kColors[] = { { 0.9f, 0.05f, 0.05f, 1 }, { 0.05f, 0.05f, 0.9f, 1 }, { 0.05f, 0.9f, 0.05f, 1 } };
    double4x4 world = translation({ 0.1, 0.2, 0.3 });
    world[0] = double4(std::cos(tilt), 0, std::sin(tilt), 0);
    world[2] = double4(-std::sin(tilt), 0, std::cos(tilt), 0);
    for (size_t i = 0; i < centers.size(); ++i) stage.add(fanMesh(centers[i]), world, { .baseColor = kColors[i % 3] });
    stage.scene.add(SunLight{ .directionWorld = { -0.4f, -0.7f, -1 } });
    stage.addConstantSky(Lux{ 8'000 });
    stage.view.camera = Camera::lookAt({ 1.5, 1.1, 2 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 });
}

// Depths of the same plane differ by rounding, so both surfaces may show; but always in the same places.
HardCase fighting(double tilt) {
    const SceneBuilder build = [tilt](Stage& stage) { layer(stage, { { 0.3f, 0.1f }, { -0.21f, 0.37f }, {} }, tilt); };
    return { .name = fmt::format("Surfaces in one place with other vertices are drawn the same each time tilted {:g}",
                                 tilt),
             .scene = build,
             .twin = build,
             .tolerance = 0 };
}

} // namespace

std::vector<HardCase> fileRows() {
    std::vector<HardCase> rows{ fighting(0), fighting(0.7), fighting(-1.3) };
    for (auto const& part : { normalRows(), positionRows() }) rows.insert(rows.end(), part.begin(), part.end());
    return rows;
}

} // namespace filament_core::hard
