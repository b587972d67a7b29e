// SPDX-License-Identifier: Apache-2.0
// Textures, frames and alpha: at a point, a ray finds what the engine's shaders would compute.
#include "tests/tools/reference/TestScenes.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/Geometry.h"
#include "tools/reference/Material.h"
#include "tools/reference/TextureLookup.h"

namespace filament_core::reference {
namespace {

using backend::Filter;
using backend::WrapMode;

assets::Image makeImage(uint32_t width, uint32_t height, std::vector<std::array<uint8_t, 4>> const& texels,
                        backend::Format format = backend::Format::RGBA8) {
    assets::Image image{ .width = width, .height = height, .format = format, .data = {} };
    for (auto const& texel : texels) {
        for (const uint8_t component : texel) image.data.push_back(std::byte{ component });
    }
    return image;
}

constexpr Sampler kLinear{
    .magFilter = Filter::Linear, .minFilter = Filter::Linear, .wrapU = WrapMode::Repeat, .wrapV = WrapMode::Repeat
};

TEST(TextureLookup, WrapModesFoldCoordinatesAsTheApisSay) {
    const auto row = [](WrapMode mode) {
        std::vector<int> texels;
        for (int i = -5; i <= 6; ++i) texels.push_back(wrapped(i, 3, mode));
        return texels;
    };
    EXPECT_EQ(row(WrapMode::Repeat), (std::vector{ 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0 }));
    EXPECT_EQ(row(WrapMode::MirroredRepeat), (std::vector{ 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0 }));
    EXPECT_EQ(row(WrapMode::ClampToEdge), (std::vector{ 0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2 }));
}

TEST(TextureLookup, FiltersBetweenTexelCentresInLinearLight) {
    const assets::Image plain = makeImage(2, 1, { { 0, 0, 0, 0 }, { 255, 51, 0, 255 } });
    EXPECT_NEAR(lookUp(plain, kLinear, { 0.25, 0.5 }).x, 0, 1e-12);
    EXPECT_NEAR(lookUp(plain, kLinear, { 0.75, 0.5 }).x, 1, 1e-12);
    EXPECT_NEAR(lookUp(plain, kLinear, { 0.5, 0.5 }).x, 0.5, 1e-12);
    EXPECT_NEAR(lookUp(plain, kLinear, { 0.5, 0.5 }).y, 0.1, 1e-12);
    EXPECT_NEAR(lookUp(plain, kLinear, { 1.0, 7.5 }).x, 0.5, 1e-12) << "repeats";
    const assets::Image srgb = makeImage(2, 1, { { 0, 0, 0, 0 }, { 188, 0, 0, 128 } }, backend::Format::RGBA8Srgb);
    const double bright = shader::lib64::linearFromSrgb(188.0 / 255);
    EXPECT_NEAR(lookUp(srgb, kLinear, { 0.5, 0.5 }).x, bright / 2, 1e-12) << "decoded before filtering";
    EXPECT_NEAR(lookUp(srgb, kLinear, { 0.75, 0.5 }).w, 128.0 / 255, 1e-12) << "alpha is not encoded";
}

TEST(TextureLookup, NearestTakesTheTexelAndBadCoordinatesAreHarmless) {
    const assets::Image image = makeImage(2, 1, { { 0, 0, 0, 0 }, { 255, 0, 0, 0 } });
    Sampler sampler = kLinear;
    sampler.magFilter = Filter::Nearest;
    EXPECT_EQ(lookUp(image, sampler, { 0.49, 0.5 }).x, 0);
    EXPECT_EQ(lookUp(image, sampler, { 0.51, 0.5 }).x, 1);
    for (const double bad : { 1e300, -1e300, std::nan(""), double(INFINITY) }) {
        EXPECT_TRUE(std::isfinite(lookUp(image, kLinear, { bad, bad }).x));
    }
}

/// A part of one triangle in the plane z = 0 whose corners have uv (0, 0), (1, 0), (0, 1).
struct Triangle {
    std::vector<assets::Image> images;
    assets::MaterialData material = lambert(1);
    assets::TangentBasis tangentBasis{};

    Part part(double4x4 const& world = double4x4(1.0)) const {
        const TestVertex vertices[3] = { { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 0 } },
                                         { { 1, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 1, 0 } },
                                         { { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1 } } };
        const uint32_t indices[3] = { 0, 1, 2 };
        Part part = makePart(makePrimitive(vertices, indices), world, double3(0.0));
        part.material = &material;
        part.images = &images;
        part.tangentBasis = tangentBasis;
        return part;
    }
    SurfaceSample at(double u, double v, double3 view = { 0, 0, 1 }) const {
        return surfaceAt(part(), { 0, u, v }, view);
    }
    assets::TextureRef texture(assets::Image image) {
        images.push_back(std::move(image));
        return { .image = static_cast<uint32_t>(images.size() - 1), .sampler = kLinear };
    }
};

TEST(Material, MetalAndDielectricSplitTheBaseColor) {
    Triangle triangle;
    triangle.material.baseColorFactor = { 0.2f, 0.4f, 0.8f, 1 };
    triangle.material.metallicFactor = 0.25f;
    triangle.material.roughnessFactor = 0.6f;
    const SurfaceSample surface = triangle.at(0.2, 0.2);
    EXPECT_NEAR(surface.diffuse.y, 0.4 * 0.75, 1e-6);
    EXPECT_NEAR(surface.f0.z, 0.04 * 0.75 + 0.8 * 0.25, 1e-6);
    EXPECT_EQ(surface.f90, 1);
    EXPECT_NEAR(surface.perceptualRoughness, 0.6, 1e-6);
    triangle.material.roughnessFactor = 0;
    EXPECT_EQ(triangle.at(0.2, 0.2).perceptualRoughness, 0.045) << "the engine's least";
    triangle.material = metal(0.5f, float3(0.001f));
    EXPECT_NEAR(triangle.at(0.2, 0.2).f90, 3 * 0.001 * 16.5, 1e-6) << "black metal does not reflect at grazing either";
}

TEST(Material, TexturesMultiplyTheFactorsInTheChannelsOfTheSpecification) {
    Triangle triangle;
    triangle.material.baseColorFactor = float4(0.5f, 0.5f, 0.5f, 1);
    triangle.material.roughnessFactor = 0.5f;
    triangle.material.metallicFactor = 0.5f;
    triangle.material.occlusionStrength = 0.5f;
    triangle.material.emissiveFactor = float3(1, 2, 3);
    triangle.material.emissiveStrength = 2;
    triangle.material.baseColor = triangle.texture(makeImage(1, 1, { { 51, 102, 255, 255 } }));
    triangle.material.metallicRoughness = triangle.texture(makeImage(1, 1, { { 1, 204, 51, 255 } }));
    triangle.material.occlusion = triangle.texture(makeImage(1, 1, { { 102, 0, 0, 255 } }));
    triangle.material.emissive = triangle.texture(makeImage(1, 1, { { 255, 51, 0, 255 } }));
    const SurfaceSample surface = triangle.at(0.3, 0.3);
    EXPECT_NEAR(surface.diffuse.x, 0.5 * 0.2 * (1 - 0.1), 1e-6);
    EXPECT_NEAR(surface.perceptualRoughness, 0.5 * 0.8, 1e-6);
    EXPECT_NEAR(surface.f0.z, 0.04 * 0.9 + 0.5 * 0.1, 1e-6);
    EXPECT_NEAR(surface.occlusion, 1 + 0.5 * (0.4 - 1), 1e-6);
    EXPECT_NEAR(surface.emitted.x, 2, 1e-6);
    EXPECT_NEAR(surface.emitted.y, 2 * 2 * 0.2, 1e-6);
    EXPECT_EQ(surface.emitted.z, 0);
}

TEST(Material, CoordinatesAreInterpolatedAndTransformed) {
    Triangle triangle;
    triangle.material.baseColor = triangle.texture(
            makeImage(2, 2, { { 0, 0, 0, 255 }, { 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 255, 255, 0, 255 } }));
    EXPECT_NEAR(triangle.at(0.6, 0.3).diffuse.x, 0.7, 1e-6) << "uv = (0.6, 0.3), 0.35 of a texel beyond the centre";
    EXPECT_NEAR(triangle.at(0.6, 0.3).diffuse.y, 0.1, 1e-6);
    // Half the size, moved: u' = 0.5 u + 0.25, v' = 0.5 v.
    triangle.material.baseColor.uvTransform = float3x3(float3(0.5f, 0, 0), float3(0, 0.5f, 0), float3(0.25f, 0, 1));
    triangle.material.baseColor.hasTransform = true;
    EXPECT_NEAR(triangle.at(0.6, 0.3).diffuse.x, (0.55 - 0.25) * 2, 1e-6);
    triangle.material.baseColor.uvSet = 1; // which this primitive lacks: (0, 0)
    EXPECT_NEAR(triangle.at(0.6, 0.3).diffuse.x, 0, 1e-6);
}

TEST(Material, TheNormalMapTurnsTheNormalInTheTangentFrame) {
    Triangle triangle;
    // (0.6, 0, 0.8) in tangent space, nearly: 8 bits.
    triangle.material.normal = triangle.texture(makeImage(1, 1, { { 204, 128, 230, 255 } }));
    const double3 texel(204 / 127.5 - 1, 128 / 127.5 - 1, 230 / 127.5 - 1);
    const SurfaceSample surface = triangle.at(0.3, 0.3);
    EXPECT_LT(glm::distance(surface.normal, glm::normalize(texel)), 1e-4) << "t = +x, b = +y, n = +z";
    EXPECT_LT(glm::distance(surface.geometricNormal, double3(0, 0, 1)), 1e-12);
    triangle.material.normalScale = 0.5f;
    const double3 flatter = glm::normalize(texel * double3(0.5, 0.5, 1));
    EXPECT_LT(glm::distance(triangle.at(0.3, 0.3).normal, flatter), 1e-4);
    // From behind, the whole frame is reversed.
    EXPECT_LT(glm::distance(triangle.at(0.3, 0.3, { 0, 0, -1 }).normal, -flatter), 1e-4);
    EXPECT_LT(glm::distance(triangle.at(0.3, 0.3, { 0, 0, -1 }).geometricNormal, double3(0, 0, -1)), 1e-12);
}

TEST(Material, VectorsOfMapsFollowTheirTextureCoordinates) {
    Triangle triangle;
    triangle.material.normal = triangle.texture(makeImage(1, 1, { { 204, 153, 230, 255 } }));
    const double x = 204 / 127.5 - 1, y = 153 / 127.5 - 1, z = 230 / 127.5 - 1;
    triangle.material.normal.hasTransform = true;
    const auto expectNormal = [&](double2 tilt, const char* what) {
        EXPECT_LT(glm::distance(triangle.at(0.3, 0.3).normal, glm::normalize(double3(tilt, z))), 1e-4) << what;
    };
    const float3x3 mirror(float3(-1, 0, 0), float3(0, 1, 0), float3(0, 0, 1));
    const float3x3 quarter(float3(0, -1, 0), float3(1, 0, 0), float3(0, 0, 1)); // u' = v, v' = -u
    expectNormal({ x, y }, "the identity");
    triangle.material.normal.uvTransform = mirror;
    expectNormal({ -x, y }, "u' = -u");
    triangle.material.normal.uvTransform = quarter;
    expectNormal({ y, -x }, "u' points against the bitangent, v' against the tangent");
    triangle.tangentBasis.turn = assets::turnOf(triangle.material.normal);
    expectNormal({ x, y }, "the tangents contain the transform");
    // Other coordinates than the tangents follow: v grows along the bitangent of this triangle.
    triangle.tangentBasis = { .uvSet = 1 };
    expectNormal({ y, x }, "u' along y, v' against x");
    triangle.material.normal.uvTransform = mirror;
    expectNormal({ -x, -y }, "u' against x, v' along y");
    triangle.material.normal.uvTransform = float3x3(0.0f);
    expectNormal({ x, y }, "a transform that no direction survives changes none");
}

TEST(Material, MirroredAndSkewedTransformsKeepNormalsPerpendicular) {
    const Triangle triangle;
    double4x4 mirror(1.0);
    mirror[0][0] = -2; // also stretched
    const Part mirrored = triangle.part(mirror);
    EXPECT_TRUE(mirrored.isMirrored);
    EXPECT_GT(faceNormal(mirrored, 0).z, 0) << "the front stays the front";
    EXPECT_LT(glm::distance(mirrored.normals[0], double3(0, 0, 1)), 1e-4);
    EXPECT_EQ(mirrored.tangents[0].w, -1);
    double4x4 skew(1.0);
    skew[0][2] = 1; // z' = z + x
    const Part skewed = triangle.part(skew);
    EXPECT_LT(glm::distance(skewed.normals[0], glm::normalize(double3(-1, 0, 1))), 1e-4);
    EXPECT_LT(glm::distance(glm::normalize(faceNormal(skewed, 0)), skewed.normals[0]), 1e-4);
}

TEST(Material, BlendedColorsCoverAFractionAndMaskedOnesAreCutAway) {
    Triangle triangle;
    triangle.material.baseColorFactor = { 0.8f, 0.8f, 0.8f, 0.25f };
    triangle.material.emissiveFactor = float3(4);
    EXPECT_EQ(triangle.at(0.3, 0.3).opacity, 1) << "opaque ignores alpha";
    triangle.material.alphaMode = assets::AlphaMode::Blend;
    const SurfaceSample surface = triangle.at(0.3, 0.3);
    EXPECT_NEAR(surface.opacity, 0.25, 1e-6);
    EXPECT_NEAR(surface.diffuse.x, 0.8, 1e-6) << "of the covered fraction";
    EXPECT_NEAR(surface.emitted.x, 4, 1e-6);
    const Part part = triangle.part();
    EXPECT_NEAR(opacityAt(part, { 0, 0.3, 0.3 }), 0.25, 1e-6);
    EXPECT_FALSE(isMaskedOut(part, { 0, 0.3, 0.3 }));
    triangle.material.alphaMode = assets::AlphaMode::Mask;
    EXPECT_TRUE(isMaskedOut(part, { 0, 0.3, 0.3 }));
    EXPECT_EQ(opacityAt(part, { 0, 0.3, 0.3 }), 1);
    triangle.material.alphaCutoff = 0.25f; // what is not below the cutoff stays
    EXPECT_FALSE(isMaskedOut(part, { 0, 0.3, 0.3 }));
}

TEST(Material, WhatTransmitsPassesLightStraightInItsColour) {
    Triangle triangle;
    assets::MaterialData& material = triangle.material;
    material.baseColorFactor = { 0.8f, 0.4f, 0.2f, 1 };
    material.metallicFactor = 0;
    const TrianglePoint point{ 0, 0.3, 0.3 };
    const double3 down = -triangle.at(0.3, 0.3).normal;
    EXPECT_EQ(passedAt(triangle.part(), point, down), double3(0.0)) << "opaque";
    material.transmission.factor = 0.75f;
    const double f = 0.04; // of each interface at index 1.5
    for (int i = 0; i < 3; ++i) {
        const double tint = static_cast<double>(material.baseColorFactor[i]);
        EXPECT_NEAR(passedAt(triangle.part(), point, down)[i],
                    0.75 * (1 - f) * (1 - f) * tint / (1 - f * f * tint * tint), 1e-6);
        EXPECT_NEAR(passedAt(triangle.part(), point, -down)[i], passedAt(triangle.part(), point, down)[i], 1e-9);
    }
    material.transmission.thicknessMeters = 2;
    material.transmission.attenuationColor = { 0.5f, 0.25f, 1 };
    material.transmission.attenuationDistanceMeters = 1;
    for (int i = 0; i < 3; ++i) {
        const auto perMeter = static_cast<double>(material.transmission.attenuationColor[i]);
        const double tint = static_cast<double>(material.baseColorFactor[i]) * perMeter * perMeter;
        EXPECT_NEAR(passedAt(triangle.part(), point, down)[i], 0.75 * (1 - f) * tint, 1e-5);
    }
}

TEST(Material, UnlitShowsItsBaseColorAndReflectsNothing) {
    Triangle triangle;
    triangle.material.baseColorFactor = { 0.2f, 0.4f, 0.6f, 1 };
    triangle.material.unlit = true;
    const SurfaceSample surface = triangle.at(0.3, 0.3);
    EXPECT_FALSE(surface.scatters);
    EXPECT_NEAR(surface.emitted.z, 0.6, 1e-6);
}

TEST(Geometry, ReadsEveryFormatThatTheLoaderPacks) {
    assets::PrimitiveData primitive;
    primitive.vertexCount = 1;
    primitive.layout.attributes[0] = { 0, 0, backend::VertexFormat::Short4N, 0 };
    primitive.layout.attributes[1] = { 2, 0, backend::VertexFormat::UByte4N, 8 };
    primitive.layout.attributes[2] = { 3, 0, backend::VertexFormat::UShort2N, 12 };
    primitive.layout.attributes[3] = { 4, 0, backend::VertexFormat::Byte4N, 16 };
    primitive.layout.attributeCount = 4;
    primitive.layout.buffers[0].stride = 20;
    const int16_t position[4] = { 32767, -32768, 0, 16384 };
    const uint8_t color[4] = { 255, 0, 51, 128 };
    const uint16_t uv[2] = { 65535, 13107 };
    const int8_t other[4] = { 127, -128, -64, 0 };
    primitive.vertices.resize(20);
    std::memcpy(&primitive.vertices[0], position, 8);
    std::memcpy(&primitive.vertices[8], color, 4);
    std::memcpy(&primitive.vertices[12], uv, 4);
    std::memcpy(&primitive.vertices[16], other, 4);
    EXPECT_EQ(decodeAttribute(primitive, 0)[0], float4(1, -1, 0, 16384 / 32767.0f));
    EXPECT_EQ(decodeAttribute(primitive, 2)[0], float4(1, 0, 0.2f, 128 / 255.0f));
    EXPECT_EQ(decodeAttribute(primitive, 3)[0], float4(1, 0.2f, 0, 1)) << "missing components are 0, 0, 0, 1";
    EXPECT_EQ(decodeAttribute(primitive, 4)[0], float4(1, -1, -64 / 127.0f, 0));
    EXPECT_TRUE(decodeAttribute(primitive, 1).empty());
    primitive.indexFormat = backend::IndexFormat::UInt16;
    primitive.indexCount = 2;
    primitive.indices = { std::byte{ 1 }, std::byte{ 2 }, std::byte{ 3 }, std::byte{ 0 } };
    EXPECT_EQ(decodeIndices(primitive), (std::vector<uint32_t>{ 0x201, 3 }));
}

} // namespace
} // namespace filament_core::reference
