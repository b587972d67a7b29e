// SPDX-License-Identifier: Apache-2.0
// View::debugView on both APIs: what its colours say of a pixel is what the CPU finds for the point that the pixel
// shows.
#include "backend/layers/Captured.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/prepare/FroxelGrid.h"
#include "filament_core/prepare/PrepareFrame.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <optional>
#include <set>

namespace filament_core {
namespace {

using prepare::Random;

constexpr const char* kGreySurface = R"(material { name : grey, shadingModel : lit, doubleSided : true }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.5);
} })";

constexpr DebugView kAllViews[] = { DebugView::Cascades, DebugView::Atlas, DebugView::Froxels, DebugView::Lights };

// ---- docs/lights.md and docs/shadows.md, once more: 8-bit colours

int3 mixed(int3 a, int3 b, double t) { return int3(glm::round(glm::mix(double3(a), double3(b), t))); }

/// 1 for each count up to 8, then two steps a doubling.
int stepOf(int count) {
    constexpr int kEnds[] = { 12, 16, 24, 32, 48, 64, 96, 128, 192, 255 };
    if (count <= 8) return count;
    int step = 9;
    for (const int end : kEnds) {
        if (count <= end) break;
        ++step;
    }
    return step;
}

int3 colorOfCount(int count) {
    constexpr int3 kAnchors[] = { { 68, 1, 84 }, { 59, 82, 139 }, { 33, 145, 140 }, { 94, 201, 98 }, { 253, 231, 37 } };
    if (count == 0) return int3(64);
    if (count >= 256) return int3(255);
    const int step = stepOf(count);
    const double at = 4 * (step <= 8 ? (step - 1) * 0.6 / 7 : 0.6 + (step - 8) * 0.04);
    const int first = std::min(static_cast<int>(at), 3);
    return mixed(kAnchors[first], kAnchors[first + 1], at - first);
}

int3 colorAt(Image const& image, uint32_t x, uint32_t y) {
    return int3(glm::round(float3(test::bytePixel(image, x, y)) * 255.0f));
}

bool isNear(int3 a, int3 b) { return glm::all(glm::lessThanEqual(glm::abs(a - b), int3(1))); }

// ---- scenes

struct DebugStage : test::SquareStage {
    const MaterialInstance grey = instance;
    Renderer renderer{ engine };

    explicit DebugStage(Backend backend)
            : SquareStage(backend, kGreySurface, std::make_shared<backend::FrameCapture>()) {}

    Image draw(Scene const& scene, View const& view) {
        Result<Image> image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image.ok());
        return image ? std::move(*image) : Image{};
    }

    backend::CapturedFrame drawCaptured(Scene const& scene, View const& view, Image& image) {
        engine.waitIdle();
        capture->arm({});
        image = draw(scene, view);
        engine.waitIdle();
        return capture->take().value_or(backend::CapturedFrame{});
    }
};

/// What the engine prepares for such a frame, on the CPU.
struct Prepared {
    jobs::JobSystem jobs{ { .workers = 0 } };
    Arena arena;
    prepare::FramePacket packet;

    Prepared(Scene const& scene, View const& view) {
        const jobs::AdoptedThread seat(jobs);
        const std::array views{ prepare::ViewInput{
                .camera = view.camera, .size = view.size, .quality = view.quality, .debugView = view.debugView } };
        packet = prepare::prepareFrame(jobs, arena, scene.impl().upToDate(), views, {});
    }
};

/// The point of the plane z = `height` that a pixel shows, relative to the camera.
double3 pointOnPlane(View const& view, uint32_t x, uint32_t y, double height = 0) {
    const double4x4 clip(view.camera.clipFromView(static_cast<float>(view.size.x) / static_cast<float>(view.size.y)));
    const double2 ndc((x + 0.5) / view.size.x * 2 - 1, (y + 0.5) / view.size.y * 2 - 1);
    const double3 ray = double3x3(view.camera.worldFromView) * double3(ndc.x / clip[0][0], ndc.y / clip[1][1], -1);
    return ray * ((height - view.camera.position().z) / ray.z);
}

/// Calls check(x, y, point, image's colour) for the pixels whose point lies on the square of that half side around 0.
template <class Check>
void forPointsOnSquare(View const& view, Image const& image, double half, Check const& check) {
    const double3 eye = view.camera.position();
    for (uint32_t y = 0; y < view.size.y; ++y) {
        for (uint32_t x = 0; x < view.size.x; ++x) {
            const double3 point = pointOnPlane(view, x, y);
            const double3 world = point + eye;
            const bool isFront = glm::dot(point, -double3(view.camera.worldFromView[2])) > 0;
            if (isFront && std::max(std::abs(world.x), std::abs(world.y)) < half * 0.99)
                check(x, y, point, colorAt(image, x, y));
        }
    }
}

struct ReachingLamp {
    double3 at{ 0 };
    double3 direction{ 0, 0, -1 };
    double range = 0, inner = 0, outer = 0; ///< outer 0: a point
    bool isArea = false;
};

/// In metres over the edge of what a lamp reaches; below 0: it is reached.
double beyondReach(ReachingLamp const& lamp, double3 const& world) {
    const double3 away = world - lamp.at;
    double beyond = lamp.range > 0 ? glm::length(away) - lamp.range : -1.0;
    if (lamp.outer > 0) {
        const double cosine = glm::dot(glm::normalize(away), lamp.direction);
        beyond = std::max(beyond, (std::cos(lamp.outer) - cosine) * glm::length(away));
    }
    return beyond;
}

std::vector<ReachingLamp> addLamps(Scene& scene, Random& random, int count, double widest) {
    std::vector<ReachingLamp> lamps;
    for (int i = 0; i < count; ++i) {
        ReachingLamp lamp{ .at = { random.within(-2, 2), random.within(-2, 2), random.within(0.05, 0.8) },
                           .range = random.within(0.1, widest) };
        if (i % 7 == 6) lamp.range = 0;
        const auto range = static_cast<float>(lamp.range);
        if (i % 3 == 1) {
            lamp.direction = glm::normalize(double3(random.within(-1, 1), random.within(-1, 1), -0.7));
            lamp.outer = random.within(0.2, 1.2);
            scene.add(SpotLight{ .positionWorld = lamp.at,
                                 .directionWorld = float3(lamp.direction),
                                 .rangeMeters = range,
                                 .innerConeRadians = static_cast<float>(lamp.outer / 2),
                                 .outerConeRadians = static_cast<float>(lamp.outer) });
        } else if (i % 11 == 3) {
            scene.add(DiscLight{ .positionWorld = lamp.at, .radiusMeters = 0.1f, .rangeMeters = range });
        } else {
            scene.add(PointLight{ .positionWorld = lamp.at, .rangeMeters = range });
        }
        lamps.push_back(lamp);
    }
    return lamps;
}

View viewOfPlane(uint2 size = { 96, 64 }) {
    return { .camera = Camera::lookAt({ 0.4, -2.4, 1.9 }, { 0, 0.1, 0 }, { .verticalFovDegrees = 55 }), .size = size };
}

class DebugViews : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Apis, DebugViews, testing::ValuesIn(test::kBothApis),
                         [](auto const& api) { return std::string(toString(api.param)); });

TEST_P(DebugViews, LightsCountsThoseWhoseRangeAndConeContainThePoint) {
    DebugStage stage(GetParam());
    for (const int lampCount : { 1, 3, 12, 60, 400 }) {
        for (const auto range : { DepthRange::Reversed, DepthRange::Ordinary }) {
            Random random(static_cast<uint32_t>(lampCount));
            Scene scene(stage.engine);
            stage.square.add(scene, stage.grey, {}, 2);
            const std::vector<ReachingLamp> lamps = addLamps(scene, random, lampCount, lampCount > 100 ? 2.5 : 1.2);
            View view = viewOfPlane();
            view.debugView = DebugView::Lights;
            view.quality.depthRange = range;
            const Image image = stage.draw(scene, view);
            size_t compared = 0, edges = 0;
            std::set<int> counts;
            const double margin = range == DepthRange::Reversed ? 1e-5 : 3e-4; // of a point, by its depth
            forPointsOnSquare(view, image, 2, [&](uint32_t x, uint32_t y, double3 const& point, int3 color) {
                int count = 0;
                for (ReachingLamp const& lamp : lamps) {
                    const double beyond = beyondReach(lamp, point + view.camera.position());
                    if (std::abs(beyond) < margin) count = -100'000; // either is right
                    count += beyond < 0 ? 1 : 0;
                }
                if (count < 0) {
                    ++edges;
                    return;
                }
                ++compared;
                counts.insert(stepOf(count));
                EXPECT_TRUE(isNear(color, colorOfCount(count)))
                        << lampCount << " lamps, pixel " << x << ' ' << y << " has " << count;
            });
            EXPECT_GT(compared, 2000u);
            EXPECT_LT(edges, compared / 4);
            EXPECT_GE(counts.size(), lampCount > 10 ? 4u : 2u);
            EXPECT_NE(stage.renderer.explain().find("debugView=lights: at most "), std::string::npos);
        }
    }
}

TEST_P(DebugViews, FroxelsCountsTheListOfThePointsFroxel) {
    DebugStage stage(GetParam());
    for (const int lampCount : { 2, 30, 300, 1500 }) {
        Random random(static_cast<uint32_t>(lampCount) + 7);
        Scene scene(stage.engine);
        stage.square.add(scene, stage.grey, {}, 2);
        addLamps(scene, random, lampCount, lampCount > 1000 ? 3 : 0.8);
        View view = viewOfPlane();
        view.debugView = DebugView::Froxels;
        const Image image = stage.draw(scene, view);
        const Prepared prepared(scene, view);
        prepare::ViewPacket const& packet = prepared.packet.mainView();
        const auto listOf = [&](double3 const& point) {
            const auto froxel = prepare::froxelAt(packet.uniforms, float3(point));
            return froxel ? packet.froxels.words[*froxel] % (1u << shader::kFroxelCountBits)
                          : static_cast<uint32_t>(packet.lights.size());
        };
        size_t compared = 0, full = 0;
        forPointsOnSquare(view, image, 2, [&](uint32_t x, uint32_t y, double3 const& point, int3 color) {
            const uint32_t count = listOf(point);
            for (const double3 step : { double3(1e-4, 0, 0), double3(0, 1e-4, 0), double3(0, 0, 1e-4) }) {
                if (listOf(point + step) != count || listOf(point - step) != count) return; // at a border
            }
            ++compared;
            full += count >= shader::kMaxLightsOfFroxel;
            EXPECT_TRUE(isNear(color, colorOfCount(static_cast<int>(count))))
                    << lampCount << " lamps, pixel " << x << ' ' << y << " has " << count;
        });
        EXPECT_GT(compared, 2000u);
        EXPECT_EQ(full > 0, lampCount == 1500) << "the colour of full lists is seen";
        const std::string explained = stage.renderer.explain();
        EXPECT_NE(explained.find(lampCount == 2 ? "no grid, 2 lights everywhere" : "debugView=froxels: at most "),
                  std::string::npos)
                << explained;
    }
}

/// A long plane with a box every few metres.
void addStreet(DebugStage& stage, Scene& scene) {
    stage.square.add(scene, stage.grey, {}, 60);
    for (int i = -12; i < 12; ++i) stage.square.add(scene, stage.grey, { 1.5 * (i % 3), 4.0 * i, 1 }, 0.4);
    scene.add(SunLight{ .directionWorld = { 0.4f, 0.3f, -1 } });
}

View streetView(uint32_t cascades) {
    View view{ .camera = Camera::lookAt({ 0, -50, 4 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 }), .size = { 96, 64 } };
    view.quality.shadows = ShadowFilter::Pcf3;
    view.quality.shadowMapSize = 256;
    view.quality.shadowCascades = static_cast<uint8_t>(cascades);
    view.debugView = DebugView::Cascades;
    return view;
}

/// shadows.glsl on the CPU: the first cascade whose tile contains a point and all of a filter around it; -1: none.
/// Nothing at a border.
std::optional<int> cascadeOf(shader::ShadowUniforms const& shadows, double3 const& point) {
    for (int i = 0; i < static_cast<int>(shadows.sun.y); ++i) {
        shader::ShadowMapRecord const& map = shadows.maps[static_cast<size_t>(shadows.sun.x) + static_cast<size_t>(i)];
        const double4 at = double4x4(map.atlasFromWorld) * double4(point, 1);
        const double2 place = double2(at) / at.w;
        const double2 inner = glm::min(place - (double2(map.tile.x, map.tile.y) + 3.0),
                                       double2(map.tile.z, map.tile.w) - 3.0 - place);
        const double depth = std::min(inner.x, inner.y);
        if (std::abs(depth) < 0.02) return std::nullopt;
        if (depth > 0) return i;
    }
    return -1;
}

TEST_P(DebugViews, CascadesTintsEachPixelByTheFirstCascadeThatContainsIt) {
    constexpr int3 kTints[] = {
        { 153, 153, 153 }, { 230, 159, 0 }, { 86, 180, 233 }, { 0, 158, 115 }, { 204, 121, 167 }
    };
    DebugStage stage(GetParam());
    for (const uint32_t cascades : { 1u, 2u, 4u }) {
        Scene scene(stage.engine);
        addStreet(stage, scene);
        const View view = streetView(cascades);
        const Image image = stage.draw(scene, view);
        const Prepared prepared(scene, view);
        ASSERT_NE(prepared.packet.shadows.uniforms, nullptr);
        size_t compared = 0;
        std::set<int> seen;
        forPointsOnSquare(view, image, 60, [&](uint32_t x, uint32_t y, double3 const& point, int3 color) {
            const std::optional<int> cascade = cascadeOf(*prepared.packet.shadows.uniforms, point);
            if (!cascade) return;
            const double3 tint(kTints[*cascade + 1]);
            const double grey = glm::dot(double3(color), tint) / glm::dot(tint, tint);
            // Boxes hide some of the plane: their points are elsewhere, in the same cascade or its neighbours.
            const bool isPlane = glm::length(double3(color) - tint * grey) <= 1.5;
            compared += isPlane;
            EXPECT_TRUE(!isPlane || (grey > 0.34 && grey < 1.01)) << grey;
            if (isPlane) seen.insert(*cascade);
            (void)x, (void)y;
        });
        size_t all = 0;
        forPointsOnSquare(view, image, 60, [&](uint32_t, uint32_t, double3 const&, int3) { ++all; });
        EXPECT_GT(compared, all * 95 / 100) << cascades << " of " << all;
        EXPECT_GE(seen.size(), cascades == 4 ? 3u : 1u);
        EXPECT_NE(stage.renderer.explain().find("debugView=cascades: "), std::string::npos);
    }
    Scene dark(stage.engine);
    stage.square.add(dark, stage.grey, {}, 60);
    const Image image = stage.draw(dark, streetView(2));
    for (uint32_t x = 0; x < image.width; ++x) {
        const int3 color = colorAt(image, x, 50);
        EXPECT_TRUE(color.x == color.y && color.y == color.z) << "without cascades nothing is tinted";
    }
    EXPECT_NE(stage.renderer.explain().find("debugView=cascades: none, the sun has no shadow map"), std::string::npos);
}

TEST_P(DebugViews, AtlasShowsTheDepthsOfTheAtlasAndTheEdgesOfItsTiles) {
    for (const uint2 size : { uint2(64, 64), uint2(200, 130), uint2(48, 90) }) {
        DebugStage stage(GetParam());
        Scene scene(stage.engine);
        addStreet(stage, scene);
        scene.add(SpotLight{ .positionWorld = { 0, -40, 5 }, .directionWorld = { 0, 0.3f, -1 }, .rangeMeters = 20 });
        View view = streetView(2);
        view.debugView = DebugView::Atlas;
        view.size = size;
        Image image;
        const backend::CapturedFrame frame = stage.drawCaptured(scene, view, image);
        const auto drawn = std::ranges::find(frame.passes, "shadow maps", &backend::CapturedPass::name);
        ASSERT_NE(drawn, frame.passes.end());
        backend::CapturedAttachment const& atlas = drawn->attachments.back();
        ASSERT_TRUE(atlas.isDepth);
        const Prepared prepared(scene, view);
        ASSERT_EQ(prepared.packet.shadows.maps.size(), 3u);
        const uint32_t side = std::min(size.x, size.y), left = (size.x - side) / 2, top = (size.y - side) / 2;
        const double perPixel = static_cast<double>(atlas.width) / side;
        size_t outlines = 0, depths = 0;
        for (uint32_t y = 0; y < size.y; ++y) {
            for (uint32_t x = 0; x < size.x; ++x) {
                const double2 at(x + 0.5 - left, y + 0.5 - top);
                if (at.x < 0 || at.y < 0 || at.x > side || at.y > side) {
                    EXPECT_EQ(colorAt(image, x, y), int3(0)) << "beside the atlas";
                    continue;
                }
                double nearest = 1e9; // pixels to the edge of the tile
                for (prepare::ShadowMapPacket const& map : prepared.packet.shadows.maps) {
                    const double2 first = double2(map.held.tile.x, map.held.tile.y) / perPixel;
                    const double2 inner = glm::min(at - first, first + map.held.tile.size / perPixel - at);
                    if (std::min(inner.x, inner.y) > 0) nearest = std::min(inner.x, inner.y);
                }
                if (std::abs(nearest - 1) < 1e-3 || nearest < 1e-3) continue;
                if (nearest == 1e9) {
                    EXPECT_EQ(colorAt(image, x, y), int3(0)) << "no tile";
                    continue;
                }
                if (nearest < 1) {
                    ++outlines;
                    EXPECT_TRUE(isNear(colorAt(image, x, y), int3(230, 159, 0))) << x << ' ' << y;
                    continue;
                }
                const auto texel = uint2(glm::floor(at * perPixel));
                float depth = 0;
                std::memcpy(&depth, atlas.bytes.data() + (size_t{ texel.y } * atlas.width + texel.x) * 4, 4);
                depths += depth > 0;
                EXPECT_TRUE(isNear(colorAt(image, x, y),
                                   int3(static_cast<int>(std::lround(std::pow(double{ depth }, 0.25) * 255)))))
                        << x << ' ' << y;
            }
        }
        EXPECT_GT(outlines, 100u);
        EXPECT_GT(depths, 300u);
        EXPECT_NE(stage.renderer.explain().find("debugView=atlas: 3 maps in "), std::string::npos)
                << stage.renderer.explain();
    }
}

TEST_P(DebugViews, AtlasIsBlackAndSaysWhyWithoutShadows) {
    DebugStage stage(GetParam());
    Scene scene(stage.engine);
    addStreet(stage, scene);
    View view = streetView(2);
    view.debugView = DebugView::Atlas;
    view.quality.shadows = ShadowFilter::Off;
    const Image image = stage.draw(scene, view);
    for (uint32_t i = 0; i < 96 * 64; ++i) ASSERT_EQ(colorAt(image, i % 96, i / 96), int3(0));
    const std::string explained = stage.renderer.explain();
    EXPECT_NE(explained.find("debugView=atlas: black, there is no atlas"), std::string::npos) << explained;
}

void addLife(DebugStage& stage, Scene& scene) {
    addStreet(stage, scene);
    Random random(5);
    addLamps(scene, random, 40, 1.5);
    scene.add(PointLight{ .positionWorld = { 1, -42, 3 }, .rangeMeters = 15 });
}

TEST(DebugViewsOfBothApis, HaveTheSameBits) {
    DebugStage vulkan(Backend::Vulkan), gles(Backend::Gles);
    Scene first(vulkan.engine), second(gles.engine);
    addLife(vulkan, first);
    addLife(gles, second);
    for (const DebugView debugView : kAllViews) {
        for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
            View view = streetView(3);
            view.debugView = debugView;
            view.samples = samples;
            const Image one = vulkan.draw(first, view), other = gles.draw(second, view);
            EXPECT_EQ(one.pixels, other.pixels) << toString(debugView);
            EXPECT_EQ(test::renderLinear(vulkan.engine, first, view).pixels,
                      test::renderLinear(gles.engine, second, view).pixels)
                    << toString(debugView);
            view.samples = 1;
            EXPECT_EQ(vulkan.draw(first, view).pixels, one.pixels) << "samples are left out";
        }
    }
}

TEST_P(DebugViews, LinearTargetsHoldTheLightOfTheSameColours) {
    DebugStage stage(GetParam());
    Scene scene(stage.engine);
    addLife(stage, scene);
    for (const DebugView debugView : kAllViews) {
        View view = streetView(3);
        view.debugView = debugView;
        const Image shown = stage.draw(scene, view), light = test::renderLinear(stage.engine, scene, view);
        for (uint32_t i = 0; i < 96 * 64; ++i) {
            const float4 pixel = test::halfPixel(light, i % 96, i / 96);
            const int3 color = colorAt(shown, i % 96, i / 96);
            for (int c = 0; c < 3; ++c) {
                const double x = static_cast<double>(pixel[c]);
                const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
                ASSERT_NEAR(encoded * 255, color[c], 0.75) << toString(debugView);
            }
        }
    }
}

// Passes, draws, attachments: all that a frame records and makes.
TEST_P(DebugViews, LeaveNothingBehindWhenTheyAreOff) {
    DebugStage touched(GetParam()), fresh(GetParam());
    Scene first(touched.engine), second(fresh.engine);
    addLife(touched, first);
    addLife(fresh, second);
    View view = streetView(2);
    for (const DebugView debugView : kAllViews) {
        view.debugView = debugView;
        touched.draw(first, view);
    }
    view.debugView = DebugView::None;
    Image a, b;
    touched.draw(first, view);
    fresh.draw(second, view);
    const backend::CapturedFrame one = touched.drawCaptured(first, view, a);
    const backend::CapturedFrame other = fresh.drawCaptured(second, view, b);
    EXPECT_EQ(a.pixels, b.pixels);
    ASSERT_EQ(one.passes.size(), other.passes.size());
    ASSERT_EQ(one.draws.size(), other.draws.size());
    for (size_t i = 0; i < one.passes.size(); ++i) {
        EXPECT_EQ(one.passes[i].name, other.passes[i].name);
        EXPECT_EQ(one.passes[i].last - one.passes[i].first, other.passes[i].last - other.passes[i].first);
        ASSERT_EQ(one.passes[i].attachments.size(), other.passes[i].attachments.size());
        for (size_t k = 0; k < one.passes[i].attachments.size(); ++k)
            EXPECT_EQ(one.passes[i].attachments[k].bytes, other.passes[i].attachments[k].bytes);
    }
    for (size_t i = 0; i < one.draws.size(); ++i) EXPECT_EQ(one.draws[i].pipeline, other.draws[i].pipeline);
    EXPECT_EQ(touched.renderer.explain().find("debug view"), std::string::npos);
}

} // namespace
} // namespace filament_core
