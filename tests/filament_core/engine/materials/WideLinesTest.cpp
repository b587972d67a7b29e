// SPDX-License-Identifier: Apache-2.0
// Every pixel of a wide line against the rectangle that it should be, computed in double precision; the same bits on
// both APIs.
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <filament_core/Lines.h>

#include <limits>
#include <random>

namespace filament_core {
namespace {

using test::halfPixel;
using test::MaterialStage;
using test::onBothApis;

constexpr std::string_view kWideLine = R"(material { name : line, shadingModel : unlit, wideLines : true,
    requires : [ color, custom0 ], parameters : [ { type : float, name : width } ] }
vertex { void materialVertex(inout MaterialVertexInputs material) { material.lineWidth = materialParams.width; } }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = getColor();
} })";

constexpr uint32_t kPixels = 64;
constexpr float kNear = 0.25f;

struct Segment {
    float3 begin{ 0 }, end{ 0 };
    float width = 1;
};

void addLines(MaterialStage& stage, LineQuads const& quads, float width) {
    const MaterialInstance instance = stage.material(kWideLine);
    EXPECT_TRUE(stage.engine.set(instance, "width", width));
    auto vertices = std::make_shared<Owned<VertexBuffer>>(stage.engine.own(stage.engine.create(quads.vertexBuffer())));
    auto indices = std::make_shared<Owned<IndexBuffer>>(stage.engine.own(stage.engine.create(quads.indexBuffer())));
    stage.scene.add({ .vertices = *vertices, .indices = *indices, .material = instance, .culled = false });
    stage.keep(vertices);
    stage.keep(indices);
}

void setView(MaterialStage& stage) {
    stage.view.size = { kPixels, kPixels };
    stage.view.camera = Camera::lookAt({ 0, 0, 4 }, { 0, 0, 0 }, { .verticalFovDegrees = 45, .nearMeters = kNear });
}

Image drawn(Segment const& segment) {
    return onBothApis([&](MaterialStage& stage) {
        setView(stage);
        const float3 points[] = { segment.begin, segment.end };
        addLines(stage, makeLineQuads(points, PrimitiveType::Lines), segment.width);
    });
}

bool isDrawn(Image const& image, uint32_t x, uint32_t y) { return halfPixel(image, x, y).x > 0; }

uint32_t countDrawn(Image const& image) {
    uint32_t count = 0;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) count += isDrawn(image, x, y);
    return count;
}

/// The rectangle in pixels: from `begin` along `direction` over `length`.
struct Rectangle {
    double2 begin{ 0 }, direction{ 0 };
    double length = 0, halfWidth = 0;

    /// > 0 inside: the distance to the nearest edge.
    double depthInside(double2 point) const {
        const double2 d = point - begin;
        const double along = glm::dot(d, direction), across = std::abs(d.x * direction.y - d.y * direction.x);
        return std::min({ along, length - along, halfWidth - across });
    }
};

double2 pixelOf(float3 point) {
    const double distance = 4.0 - point.z; // the camera is at z = 4 and looks down -z
    const double scale = 1 / std::tan(0.5 * 45 * 3.14159265358979323846 / 180);
    const double2 ndc(point.x * scale / distance, -point.y * scale / distance); // +y is row 0
    return (ndc + 1.0) * 0.5 * double{ kPixels };
}

/// The part in front of the near plane.
Rectangle rectangleOf(Segment const& segment) {
    constexpr float kNearZ = 4 - kNear;
    float3 end = segment.end;
    if (end.z > kNearZ) {
        const float t = (kNearZ - segment.begin.z) / (end.z - segment.begin.z);
        end = segment.begin + t * (end - segment.begin);
    }
    const double2 begin = pixelOf(segment.begin), along = pixelOf(end) - begin;
    const double length = glm::length(along);
    return { begin, along / length, length, 0.5 * segment.width };
}

void expectRectangle(Segment const& segment, Image const& image, int seed) {
    constexpr double kRounding = 0.02; // pixels: positions snap to 1/256, and clipping rounds
    const Rectangle rectangle = rectangleOf(segment);
    uint32_t wrong = 0;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const double inside = rectangle.depthInside(double2(x, y) + 0.5);
            if (std::abs(inside) > kRounding) wrong += (inside > 0) != isDrawn(image, x, y);
        }
    }
    EXPECT_EQ(wrong, 0u) << "pixels, seed " << seed;
}

class Random {
public:
    explicit Random(int seed) : mBits(static_cast<uint32_t>(seed)) {}
    float between(float low, float high) { return low + (high - low) * static_cast<float>(mBits()) / 4294967295.0f; }

private:
    std::mt19937 mBits;
};

TEST(WideLines, CoverTheirRectangleAtAnyAngleDepthAndWidth) {
    for (int seed = 0; seed < 24; ++seed) {
        Random random(seed);
        const auto point = [&] {
            return float3(random.between(-1, 1), random.between(-1, 1), random.between(-3, 1.5f));
        };
        const Segment segment{ point(), point(), random.between(1, 14) };
        expectRectangle(segment, drawn(segment), seed);
    }
}

TEST(WideLines, KeepWidthAndDirectionWhereTheOtherEndIsBehindTheCamera) {
    for (int seed = 100; seed < 112; ++seed) {
        Random random(seed);
        const float3 begin(random.between(-0.5f, 0.5f), random.between(-0.5f, 0.5f), random.between(-2, 1));
        const float3 end(random.between(2, 5), random.between(-5, 5), random.between(4.5f, 9));
        const Segment segment{ begin, end, random.between(2, 10) };
        const Image picture = drawn(segment);
        expectRectangle(segment, picture, seed);
        EXPECT_GT(countDrawn(picture), 20u) << "seed " << seed;
    }
}

TEST(WideLines, DrawNothingForWidthsThatAreNone) {
    for (const float width : { 0.0f, -3.0f, std::numeric_limits<float>::quiet_NaN() })
        EXPECT_EQ(countDrawn(drawn({ { -1, 0, 0 }, { 1, 0.3f, 0 }, width })), 0u) << width;
    EXPECT_EQ(countDrawn(drawn({ { 0.5f, 0.5f, 0 }, { 0.5f, 0.5f, 0 }, 8 })), 0u) << "a segment without length";
}

TEST(WideLines, AreAtMost1024PixelsWide) {
    const Segment wide{ { -2, 0, 0 }, { 2, 0, 0 }, std::numeric_limits<float>::infinity() };
    EXPECT_EQ(countDrawn(drawn(wide)), kPixels * kPixels);
}

TEST(WideLines, StripsAndSinglePairsDrawTheSameSegments) {
    const float3 strip[] = { { -1, -1, 0 }, { 1, -0.5f, 0 }, { 0.2f, 1, -1 } };
    const float3 pairs[] = { strip[0], strip[1], strip[1], strip[2], strip[0] }; // the last has no partner
    const float4 red(1, 0, 0, 1), green(0, 1, 0, 1);
    const float4 ofStrip[] = { red, green, red }, ofPairs[] = { red, green, green, red, green };
    const auto picture = [](LineQuads const& quads) {
        return onBothApis([&](MaterialStage& stage) {
            setView(stage);
            addLines(stage, quads, 6);
        });
    };
    const Image a = picture(makeLineQuads(strip, PrimitiveType::LineStrip, ofStrip));
    const Image b = picture(makeLineQuads(pairs, PrimitiveType::Lines, ofPairs));
    EXPECT_EQ(a.pixels, b.pixels);
    EXPECT_GT(countDrawn(a), 300u);
}

TEST(WideLines, OfFewerThanTwoPointsHaveNoCorners) {
    const float3 one[] = { { 1, 2, 3 } };
    for (const PrimitiveType primitive : { PrimitiveType::Lines, PrimitiveType::LineStrip }) {
        EXPECT_TRUE(makeLineQuads({}, primitive).vertices.empty());
        EXPECT_TRUE(makeLineQuads(one, primitive).indices.empty());
    }
}

} // namespace
} // namespace filament_core
