// SPDX-License-Identifier: Apache-2.0
// Textures of vectors (normals, coat normals, directions of anisotropy) follow their own texture coordinates: a
// transform draws what a mesh draws whose coordinates contain it, and two maps of one material do not disturb each
// other.
#include "filament_core/assets/gltf/GltfWriter.h"
#include "tests/filament_core/engine/gltf/SquareGrid.h"

#include <cmath>
#include <optional>
#include <span>

namespace filament_core::vector_textures {
namespace {

using assets::test::Json;
using assets::test::TestFile;

enum class Map { Normal, CoatNormal, Anisotropy };
constexpr Map kMaps[] = { Map::Normal, Map::CoatNormal, Map::Anisotropy };

struct Transform {
    double rotation = 0; ///< degrees
    double2 scale{ 1 }, offset{ 0 };

    /// KHR_texture_transform: scale, then turn, then move; positive angles as in TextureTransformTest.
    double2 operator()(double2 uv) const {
        const double2 s = uv * scale;
        const double c = std::cos(glm::radians(rotation)), n = std::sin(glm::radians(rotation));
        return double2(c * s.x + n * s.y, -n * s.x + c * s.y) + offset;
    }
    Json json() const {
        return { { "rotation", glm::radians(rotation) },
                 { "scale", { scale.x, scale.y } },
                 { "offset", { offset.x, offset.y } } };
    }
};

constexpr Transform kTransforms[] = {
    {},
    { .rotation = 90, .offset = { 0, 1 } },
    { .rotation = 180, .offset = { 1, 1 } },
    { .rotation = 270 },
    { .rotation = 30 },
    { .rotation = -45, .scale = { 2, 2 } },
    { .scale = { -1, 1 }, .offset = { 1, 0 } },
    { .scale = { 1, -1 } },
    { .rotation = 60, .scale = { -3, 3 } },
    { .scale = { 3, 0.5 } },
};

/// A texture without a neighbour that differs: one vector.
struct Vector {
    Map map = Map::Normal;
    int set = 0;
    Transform transform{};
    bool isBaked = false; ///< the coordinates of the mesh contain the transform
};

/// Texture coordinates of the square's corners in a set, as a linear function of their place in the plane.
struct Mapping {
    double2 alongX{ 1, 0 }, alongY{ 0, -1 };
    double2 operator()(double2 at) const { return alongX * at.x + alongY * at.y; }
};
constexpr Mapping kUpright{}, kTilted{ { 0.8, -0.6 }, { -0.6, -0.8 } }, kMirrored{ { 0, 1 }, { 1, 0 } },
        kStretched{ { 2, 0.3 }, { 0.1, -0.7 } };

struct Square {
    Mapping sets[2]{ kUpright, kTilted };
    std::optional<int> tangentSet{}; ///< the set that the file's tangents follow; none: it has none
    std::vector<Vector> vectors;

    double2 uvAt(int set, double2 at) const {
        double2 uv = sets[set](at);
        for (Vector const& vector : vectors)
            if (vector.isBaked && vector.set == set) uv = vector.transform(uv);
        return uv;
    }
    /// Along which u grows and v stays, from the inverse of the mapping; w: the bitangent points against v.
    float4 tangent() const {
        const double2 origin = uvAt(*tangentSet, { 0, 0 });
        const double2 x = uvAt(*tangentSet, { 1, 0 }) - origin, y = uvAt(*tangentSet, { 0, 1 }) - origin;
        const double area = x.x * y.y - y.x * x.y;
        const double2 along = glm::normalize(double2(y.y, -x.y) / area);
        return { float2(along), 0, area < 0 ? 1 : -1 };
    }
};

size_t addTexture(TestFile& file, std::array<int, 3> texel) {
    std::vector<std::byte> pixel;
    for (const int code : { texel[0], texel[1], texel[2], 255 }) pixel.push_back(static_cast<std::byte>(code));
    const Result<assets::GlbImage> png = assets::glbImageFromPixels("vector", 1, 1, pixel);
    file.root["images"].push_back({ { "bufferView", file.addView(png->file) }, { "mimeType", "image/png" } });
    file.root["textures"].push_back({ { "source", file.root["images"].size() - 1 } });
    return file.root["textures"].size() - 1;
}

Json infoOf(TestFile& file, Vector const& vector) {
    Json info{ { "index", addTexture(file, vector.map == Map::Anisotropy ? std::array{ 220, 170, 255 }
                                                                         : std::array{ 190, 160, 235 }) },
               { "texCoord", vector.set } };
    if (!vector.isBaked) info["extensions"]["KHR_texture_transform"] = vector.transform.json();
    return info;
}

Json materialOf(TestFile& file, Square const& square) {
    Json material{ { "doubleSided", true },
                   { "pbrMetallicRoughness", { { "roughnessFactor", 0.5 } } },
                   { "extensions", Json::object() } };
    for (Vector const& vector : square.vectors) {
        Json& extensions = material["extensions"];
        switch (vector.map) {
        case Map::Normal:
            material["normalTexture"] = infoOf(file, vector);
            break;
        case Map::CoatNormal: // over black: the coat alone is seen
            material["pbrMetallicRoughness"] = { { "baseColorFactor", { 0, 0, 0, 1 } }, { "metallicFactor", 0 } };
            extensions["KHR_materials_specular"] = { { "specularFactor", 0 } };
            extensions["KHR_materials_clearcoat"] = { { "clearcoatFactor", 1 }, { "clearcoatRoughnessFactor", 0.4 } };
            extensions["KHR_materials_clearcoat"]["clearcoatNormalTexture"] = infoOf(file, vector);
            break;
        case Map::Anisotropy:
            extensions["KHR_materials_anisotropy"] = { { "anisotropyStrength", 0.9 },
                                                       { "anisotropyRotation", 0.3 },
                                                       { "anisotropyTexture", infoOf(file, vector) } };
            break;
        }
    }
    return material;
}

Json primitiveOf(TestFile& file, Square const& square) {
    using assets::test::kFloat;
    std::vector<float> positions, normals, tangents, uvs[2];
    for (const double2 at : { double2(-1, 1), double2(-1, -1), double2(1, -1), double2(1, 1) }) {
        positions.insert(positions.end(), { float(at.x), float(at.y), 0 });
        normals.insert(normals.end(), { 0, 0, 1 });
        for (int set = 0; set < 2; ++set) {
            const float2 uv(square.uvAt(set, at));
            uvs[set].insert(uvs[set].end(), { uv.x, uv.y });
        }
        if (!square.tangentSet) continue;
        const float4 tangent = square.tangent();
        tangents.insert(tangents.end(), { tangent.x, tangent.y, tangent.z, tangent.w });
    }
    Json attributes{ { "POSITION", file.add(positions, kFloat, "VEC3", 3) },
                     { "NORMAL", file.add(normals, kFloat, "VEC3", 3) },
                     { "TEXCOORD_0", file.add(uvs[0], kFloat, "VEC2", 2) },
                     { "TEXCOORD_1", file.add(uvs[1], kFloat, "VEC2", 2) } };
    if (square.tangentSet) attributes["TANGENT"] = file.add(tangents, kFloat, "VEC4", 4);
    file.root["materials"].push_back(materialOf(file, square));
    return { { "attributes", attributes },
             { "indices", file.add(std::vector<uint16_t>{ 0, 1, 2, 0, 2, 3 }, assets::test::kUShort, "SCALAR", 1) },
             { "material", file.root["materials"].size() - 1 } };
}

/// The colours of squares under a sun from the side, scene-linear, from the front or the back: the same bits on both
/// APIs.
std::vector<float3> draw(std::span<const Square> squares, double side = 1) {
    const test::SquareGrid grid{ .columns = 32, .pixels = 2, .count = squares.size() };
    TestFile file;
    file.root["extensionsUsed"] = { "KHR_texture_transform", "KHR_materials_clearcoat", "KHR_materials_anisotropy",
                                    "KHR_materials_specular" };
    std::vector<Json> primitives;
    for (Square const& square : squares) primitives.push_back(primitiveOf(file, square));
    grid.place(file, primitives);
    const Image image = grid.draw(file.glb(), side, [&](test::MaterialStage& stage) {
        stage.scene.add(SunLight{ .directionWorld = { -0.5f, -0.3f, float(-side) }, .illuminance = Lux{ 3 } });
    });
    std::vector<float3> colors(squares.size());
    for (size_t i = 0; i < squares.size() && !image.pixels.empty(); ++i) {
        const uint2 corner = grid.cornerOf(i, side);
        colors[i] = float3(test::halfPixel(image, corner.x, corner.y));
    }
    return colors;
}

double differenceOf(float3 a, float3 b) {
    const float3 apart = glm::abs(a - b);
    return std::max({ apart.x, apart.y, apart.z }) / std::max({ b.x, b.y, b.z, 1e-3f });
}

constexpr double kAlike = 0.004; // half floats, and coordinates that are rounded before or after the transform

/// Whether tangents of the file turn as the coordinates do: where these are not stretched.
bool keepsShape(Mapping const& mapping) {
    return std::abs(glm::dot(mapping.alongX, mapping.alongY)) < 1e-9 &&
           std::abs(glm::length(mapping.alongX) - glm::length(mapping.alongY)) < 1e-9;
}

/// Draws the squares, and the same with their transforms in the coordinates.
void expectAsBaked(std::vector<Square> squares, double side = 1) {
    const std::vector<float3> turned = draw(squares, side);
    for (Square& square : squares)
        for (Vector& vector : square.vectors) vector.isBaked = true;
    const std::vector<float3> baked = draw(squares, side);
    for (size_t i = 0; i < squares.size(); ++i) {
        Vector const& first = squares[i].vectors[0];
        EXPECT_GT(baked[i].x, 0) << "nothing to see";
        EXPECT_LT(differenceOf(turned[i], baked[i]), kAlike)
                << "map " << int(first.map) << " set " << first.set << " file's tangents "
                << squares[i].tangentSet.has_value() << " rotation " << first.transform.rotation << " scale "
                << first.transform.scale.x << " " << first.transform.scale.y << " along x "
                << squares[i].sets[first.set].alongX.x << " " << squares[i].sets[first.set].alongX.y;
    }
}

TEST(VectorTextures, ATransformDrawsWhatCoordinatesDrawThatContainIt) {
    std::vector<Square> squares;
    for (const Map map : kMaps) {
        for (Mapping const& mapping : { kUpright, kTilted, kMirrored, kStretched }) {
            for (const int set : { 0, 1 }) {
                for (const bool hasTangents : { false, true }) {
                    for (Transform const& transform : kTransforms) {
                        const bool keepsAngles = std::abs(transform.scale.x) == std::abs(transform.scale.y);
                        if (hasTangents && !(keepsShape(mapping) && keepsAngles)) continue;
                        Square square{ .vectors = { { map, set, transform } } };
                        square.sets[set] = mapping;
                        if (hasTangents) square.tangentSet = set;
                        squares.push_back(square);
                    }
                }
            }
        }
    }
    EXPECT_GE(squares.size(), 300u);
    expectAsBaked(squares);
}

TEST(VectorTextures, TurnWithTheirTexture) {
    for (const Map map : kMaps) {
        std::vector<Square> squares;
        for (Transform const& transform : kTransforms) squares.push_back({ .vectors = { { map, 0, transform } } });
        const std::vector<float3> colors = draw(squares);
        for (const size_t turned : { 1u, 2u, 3u, 4u, 6u, 7u }) {
            if (map == Map::Anisotropy && turned == 2) continue; // half a turn is the same direction
            EXPECT_GT(differenceOf(colors[turned], colors[0]), 5 * kAlike) << int(map) << " by transform " << turned;
        }
    }
}

TEST(VectorTextures, TurnOnBacksAsOnFronts) {
    std::vector<Square> squares;
    for (const Map map : kMaps) {
        for (Transform const& transform : kTransforms) {
            squares.push_back({ .vectors = { { map, 1, transform } } });
            if (map != Map::Normal) squares.back().vectors.push_back({ Map::Normal, 0, {} }); // takes the tangents
        }
    }
    expectAsBaked(squares, -1);
}

TEST(VectorTextures, MapsOfOneMaterialDoNotDisturbEachOther) {
    std::vector<Square> squares;
    for (const Map map : { Map::CoatNormal, Map::Anisotropy }) {
        for (Transform const& own : kTransforms) {
            for (Transform const& other : kTransforms) {
                for (const int set : { 0, 1 })
                    squares.push_back({ .vectors = { { map, set, own }, { Map::Normal, 1 - set, other } } });
            }
        }
    }
    EXPECT_GE(squares.size(), 300u);
    expectAsBaked(squares);
}

} // namespace
} // namespace filament_core::vector_textures
