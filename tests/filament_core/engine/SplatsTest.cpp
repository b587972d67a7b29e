// SPDX-License-Identifier: Apache-2.0
// Pictures of splats on both APIs, against every pixel's splats sorted and blended on the CPU: order, encodings of
// colours, spherical harmonics, depth, what is drawn before and after, samples; scenes without them pay nothing.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <filament_core/Splats.h>

#include <gmock/gmock.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace filament_core {
namespace {

using prepare::Random;
using test::centerPixel;
using test::halfPixel;
using test::MaterialStage;
using test::onBothApis;
using testing::ElementsAre;

constexpr uint32_t kSplatSide = 48;
constexpr float3 kBehindSplats{ 0.25f, 0.5f, 0.125f };
constexpr double kEyeZ = 4;

struct SplatLook {
    float3 at{ 0 }, scale{ 0.2f };
    float4 rotation{ 0, 0, 0, 1 };
    float opacity = 0.5f;
    float3 color{ 0.5f };
};

SplatCloud cloudOf(std::vector<SplatLook> const& splats, SplatColors colors) {
    std::vector<float3> positions, scales, harmonics;
    std::vector<float4> rotations;
    std::vector<float> opacities;
    for (SplatLook const& splat : splats) {
        positions.push_back(splat.at);
        scales.push_back(splat.scale);
        rotations.push_back(splat.rotation);
        opacities.push_back(splat.opacity);
        harmonics.push_back((splat.color - 0.5f) / 0.28209479f);
    }
    Result<SplatCloud> cloud = SplatCloud::create({ .positions = positions,
                                                    .rotations = rotations,
                                                    .scales = scales,
                                                    .opacities = opacities,
                                                    .harmonics = harmonics,
                                                    .colors = colors });
    EXPECT_TRUE(cloud.ok());
    return cloud ? *cloud : SplatCloud();
}

void showSplats(MaterialStage& stage, SplatCloud const& cloud) {
    stage.view.size = uint2(kSplatSide);
    stage.view.clearColor = float4(kBehindSplats, 1);
    stage.scene.add({ .splats = cloud });
}

Image pictureOf(SplatCloud const& cloud) {
    return onBothApis([&](MaterialStage& stage) { showSplats(stage, cloud); });
}

double decoded(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

double3x3 rotationOf(double4 q) {
    q = glm::normalize(q);
    const double x = q.x, y = q.y, z = q.z, w = q.w;
    return double3x3(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 2 * (x * y - w * z),
                     1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 2 * (x * z + w * y), 2 * (y * z - w * x),
                     1 - 2 * (x * x + y * y));
}

/// The squared distance of a pixel of the stage's view from the centre of a splat, in standard deviations.
double distance2At(SplatLook const& splat, uint32_t pixelX, uint32_t pixelY) {
    const double focus = 0.5 * kSplatSide / std::tan(glm::radians(22.5));
    const double3 v = double3(splat.at) - double3(0, 0, kEyeZ);
    const double2 center = double2(v.x, -v.y) * (focus / -v.z) + 0.5 * kSplatSide;
    const double3 toX = double3(1, 0, v.x / -v.z) * (focus / -v.z), toY = -double3(0, 1, v.y / -v.z) * (focus / -v.z);
    const double3x3 axes = rotationOf(double4(splat.rotation));
    double xx = 0.3, xy = 0, yy = 0.3;
    for (int i = 0; i < 3; ++i) {
        const double s = static_cast<double>(splat.scale[i]);
        const double x = glm::dot(toX, axes[i]) * s, y = glm::dot(toY, axes[i]) * s;
        xx += x * x, xy += x * y, yy += y * y;
    }
    const double2 d = double2(pixelX + 0.5, pixelY + 0.5) - center;
    return (yy * d.x * d.x - 2 * xy * d.x * d.y + xx * d.y * d.y) / (xx * yy - xy * xy);
}

double coverAt(SplatLook const& splat, uint32_t x, uint32_t y) {
    const double distance2 = distance2At(splat, x, y);
    return distance2 < 9 ? static_cast<double>(splat.opacity) * std::exp(-0.5 * distance2) : 0;
}

/// Whether a splat ends so near the pixel that rounding may decide.
bool isAtAnEdge(std::vector<SplatLook> const& splats, uint32_t x, uint32_t y) {
    return std::ranges::any_of(splats, [&](SplatLook const& s) { return std::abs(distance2At(s, x, y) - 9) < 0.02; });
}

/// Of splats in the order of drawing.
double3 truthAt(std::vector<SplatLook> const& splats, SplatColors colors, uint32_t x, uint32_t y) {
    double3 sum(0);
    double through = 1;
    for (SplatLook const& splat : splats) {
        const double cover = coverAt(splat, x, y);
        sum = sum * (1 - cover) + double3(splat.color) * cover;
        through *= 1 - cover;
    }
    if (colors == SplatColors::Srgb && through < 1) {
        for (int c = 0; c < 3; ++c) sum[c] = decoded(sum[c] / (1 - through)) * (1 - through);
    }
    return sum + double3(kBehindSplats) * through;
}

double largestError(Image const& image, std::vector<SplatLook> splats, SplatColors colors) {
    std::ranges::stable_sort(splats, std::greater(), [](SplatLook const& splat) {
        return glm::length(double3(splat.at) - double3(0, 0, kEyeZ));
    });
    double largest = 0;
    for (uint32_t y = 0; y < kSplatSide; ++y) {
        for (uint32_t x = 0; x < kSplatSide; ++x) {
            if (isAtAnEdge(splats, x, y)) continue;
            const double3 error = glm::abs(double3(halfPixel(image, x, y)) - truthAt(splats, colors, x, y));
            largest = std::max({ largest, error.x, error.y, error.z });
        }
    }
    return largest;
}

std::vector<SplatLook> randomSplats(size_t count, uint32_t seed) {
    Random random(seed);
    const auto number = [&](double low, double high) { return static_cast<float>(random.within(low, high)); };
    std::vector<SplatLook> splats(count);
    for (SplatLook& splat : splats) {
        splat = { .at = { number(-1.2, 1.2), number(-1.2, 1.2), number(-2, 1) },
                  .scale = { number(0.05, 0.4), number(0.05, 0.4), number(0.05, 0.4) },
                  .rotation = { number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1) },
                  .opacity = number(0.1, 1),
                  .color = { number(0, 1), number(0, 1), number(0, 1) } };
    }
    return splats;
}

/// Half floats of the layer, one step for each splat over a pixel, and corners on a grid of 1/256 pixels.
constexpr double kSplatRounding = 0.006;

TEST(Splats, ASplatIsAGaussianOverWhatIsBehindIt) {
    for (const SplatColors colors : { SplatColors::Linear, SplatColors::Srgb }) {
        const std::vector<SplatLook> one{ { .at = { 0.1f, -0.2f, 0 },
                                            .scale = { 0.5f, 0.2f, 0.1f },
                                            .rotation = { 0.1f, 0.3f, 0.5f, 0.8f },
                                            .opacity = 0.75f,
                                            .color = { 0.9f, 0.3f, 0.1f } } };
        const Image image = pictureOf(cloudOf(one, colors));
        EXPECT_LT(largestError(image, one, colors), 0.003);
    }
}

TEST(Splats, ManyBlendFarthestFirstAsEncoded) {
    for (const SplatColors colors : { SplatColors::Linear, SplatColors::Srgb }) {
        const std::vector<SplatLook> splats = randomSplats(150, 5);
        const Image image = pictureOf(cloudOf(splats, colors));
        EXPECT_LT(largestError(image, splats, colors), kSplatRounding);
        std::vector<SplatLook> reversed = splats;
        for (SplatLook& splat : reversed) splat.at.z = -splat.at.z; // the order decides
        EXPECT_GT(largestError(image, reversed, colors), 0.2);
    }
}

TEST(Splats, CloudsBlendTogetherInWhateverOrderTheyAreAdded) {
    const std::vector<SplatLook> splats = randomSplats(60, 9);
    const std::vector<SplatLook> first(splats.begin(), splats.begin() + 25), second(splats.begin() + 25, splats.end());
    const auto both = [](std::vector<SplatLook> const& a, std::vector<SplatLook> const& b) {
        return onBothApis([&](MaterialStage& stage) {
            showSplats(stage, cloudOf(a, SplatColors::Srgb));
            stage.scene.add({ .splats = cloudOf(b, SplatColors::Srgb) });
        });
    };
    const Image whole = pictureOf(cloudOf(splats, SplatColors::Srgb));
    EXPECT_EQ(both(first, second).pixels, whole.pixels);
    EXPECT_EQ(both(second, first).pixels, whole.pixels);
}

TEST(Splats, HarmonicsAreThoseOfTheDirectionInTheSpaceOfTheCloud) {
    // A cloud of one opaque splat in front of the camera, turned so that another direction of its space looks there.
    const auto seen = [](std::vector<float3> const& harmonics, uint32_t degree, double4x4 const& world) {
        const std::vector<float3> position{ { 0, 0, 0 } }, scale{ float3(2) };
        const std::vector<float4> rotation{ { 0, 0, 0, 1 } };
        const std::vector<float> opacity{ 1 };
        Result<SplatCloud> cloud = SplatCloud::create({ .positions = position,
                                                        .rotations = rotation,
                                                        .scales = scale,
                                                        .opacities = opacity,
                                                        .degree = degree,
                                                        .harmonics = harmonics,
                                                        .colors = SplatColors::Linear });
        return centerPixel(onBothApis([&](MaterialStage& stage) {
                   stage.view.size = { 9, 9 };
                   stage.scene.add({ .worldFromObject = world, .splats = *cloud });
               }))
                .x;
    };
    // Legendre polynomials along z: P1 = t, P2 = (3 t^2 - 1) / 2, P3 = (5 t^3 - 3 t) / 2.
    const double turn = glm::radians(35.0), t = -std::cos(turn); // the camera looks along -z
    const double4x4 turned = glm::rotate(double4x4(1), turn, double3(1, 0, 0));
    const double pi = std::numbers::pi;
    const auto zonal = [&](size_t k, uint32_t degree) {
        std::vector<float3> harmonics(size_t{ degree + 1 } * (degree + 1), float3(0));
        harmonics[k] = float3(0.4f);
        return seen(harmonics, degree, turned);
    };
    EXPECT_NEAR(zonal(2, 1), 0.5 + 0.4 * std::sqrt(3 / (4 * pi)) * t, 1e-3);
    EXPECT_NEAR(zonal(6, 2), 0.5 + 0.4 * std::sqrt(5 / (4 * pi)) * (3 * t * t - 1) / 2, 1e-3);
    EXPECT_NEAR(zonal(12, 3), 0.5 + 0.4 * std::sqrt(7 / (4 * pi)) * (5 * t * t * t - 3 * t) / 2, 1e-3);
    // In the space of the cloud, turned about x, the camera looks along (0, -sin, -cos) of 35 degrees.
    EXPECT_NEAR(zonal(1, 1), 0.5 + 0.4 * std::sqrt(3 / (4 * pi)) * std::sin(turn), 1e-3);
}

/// Radl et al. 2024, "StopThePop": where the ray of a pixel meets the largest density of the splat, as a distance.
double nearestAt(SplatLook const& splat, uint32_t x, uint32_t y) {
    const double3 ray(test::directionThrough(x, y, kSplatSide)), to = double3(splat.at) - double3(0, 0, kEyeZ);
    const double3x3 axes = rotationOf(double4(splat.rotation));
    double over = 0, under = 0;
    for (int i = 0; i < 3; ++i) {
        const double s = static_cast<double>(splat.scale[i]), along = glm::dot(axes[i], ray) / s;
        over += along * glm::dot(axes[i], to) / s;
        under += along * along;
    }
    return over / under;
}

struct OrderErrors {
    double rms = 0, largest = 0;
};

/// Against splats that are sorted anew for each pixel.
OrderErrors errorsOfOneOrder(Image const& image, std::vector<SplatLook> const& splats, SplatColors colors) {
    OrderErrors errors;
    std::vector<std::pair<double, size_t>> order(splats.size());
    std::vector<SplatLook> sorted(splats.size());
    for (uint32_t y = 0; y < kSplatSide; ++y) {
        for (uint32_t x = 0; x < kSplatSide; ++x) {
            for (size_t i = 0; i < splats.size(); ++i) order[i] = { nearestAt(splats[i], x, y), i };
            std::ranges::sort(order, std::greater());
            for (size_t i = 0; i < splats.size(); ++i) sorted[i] = splats[order[i].second];
            const double3 error = glm::abs(double3(halfPixel(image, x, y)) - truthAt(sorted, colors, x, y));
            errors.rms += glm::dot(error, error) / 3;
            errors.largest = std::max({ errors.largest, error.x, error.y, error.z });
        }
    }
    errors.rms = std::sqrt(errors.rms / (kSplatSide * kSplatSide));
    return errors;
}

/// The table of docs/splats.md.
TEST(Splats, OneOrderForAllPixelsIsNearTheExactOrderOfEach) {
    struct Case {
        size_t count;
        double size; ///< of splats against those of randomSplats()
    };
    for (Case const& one : { Case{ 1000, 0.4 }, Case{ 300, 0.6 }, Case{ 100, 1 } }) {
        std::vector<SplatLook> splats = randomSplats(one.count, 21);
        for (SplatLook& splat : splats) splat.scale *= static_cast<float>(one.size);
        const Image image = pictureOf(cloudOf(splats, SplatColors::Srgb));
        const OrderErrors errors = errorsOfOneOrder(image, splats, SplatColors::Srgb);
        std::printf("%zu splats of size %.1f: rms %.4f, largest %.3f\n", one.count, one.size, errors.rms,
                    errors.largest);
        EXPECT_LT(errors.rms, 0.03);
        EXPECT_LT(errors.largest, 0.4);
        EXPECT_GT(errors.rms, 0.002) << "splats intersect";
    }
}

TEST(Splats, SurfacesHideThemByTheirDepthAndBlendOverThem) {
    const std::string opaque =
            test::text("shadingModel : unlit, requires : [ color ]", "material.baseColor = getColor();");
    const std::string pane = test::text("shadingModel : unlit, requires : [ color ], blending : transparent",
                                        "material.baseColor = getColor();");
    const SplatCloud white =
            cloudOf({ { .at = { 0, 0, 0 }, .scale = float3(3), .opacity = 1, .color = float3(1) } }, SplatColors::Srgb);
    const auto middle = [&](std::string const& text, float z, float4 color) {
        return centerPixel(onBothApis([&](MaterialStage& stage) {
            stage.view.size = { 9, 9 };
            stage.scene.add({ .splats = white });
            stage.add(stage.material(text, test::kNoLights), { { .z = z, .color = color } });
        }));
    };
    test::expectNear(middle(opaque, 0.5f, { 1, 0, 0, 1 }), { 1, 0, 0 }, 1e-3f);
    test::expectNear(middle(opaque, -0.5f, { 1, 0, 0, 1 }), { 1, 1, 1 }, 1e-3f);
    test::expectNear(middle(pane, 0.5f, { 0.5f, 0, 0, 0.5f }), { 1, 0.5f, 0.5f }, 1e-3f);
    test::expectNear(middle(pane, -0.5f, { 0.5f, 0, 0, 0.5f }), { 1, 0.5f, 0.5f }, 1e-3f); // also behind them
}

TEST(Splats, SeveralSamplesAPixelShowTheSameSplats) {
    const std::vector<SplatLook> splats = randomSplats(40, 2);
    const SplatCloud cloud = cloudOf(splats, SplatColors::Srgb);
    const Image one = pictureOf(cloud);
    const Image four = onBothApis([&](MaterialStage& stage) {
        showSplats(stage, cloud);
        stage.view.samples = 4;
    });
    for (uint32_t y = 0; y < kSplatSide; ++y) {
        for (uint32_t x = 0; x < kSplatSide; ++x)
            test::expectNear(halfPixel(four, x, y), float3(halfPixel(one, x, y)), 2e-3f);
    }
}

TEST(Splats, FollowTheirNodeAndItsVisibility) {
    const std::vector<SplatLook> one{ { .opacity = 1, .color = float3(1) } };
    const auto shown = [&](auto&& change) {
        return centerPixel(onBothApis([&](MaterialStage& stage) {
                   stage.view.size = { 9, 9 };
                   const Node node = stage.scene.add(NodeDesc{});
                   const Renderable splats =
                           stage.scene.add({ .node = node, .splats = cloudOf(one, SplatColors::Linear) });
                   change(stage.scene, node, splats);
               }))
                .x;
    };
    EXPECT_NEAR(shown([](Scene&, Node, Renderable) {}), 1, 1e-2);
    EXPECT_EQ(shown([](Scene& scene, Node node, Renderable) {
                  scene.setTransform(node, glm::translate(double4x4(1), double3(3, 0, 0)));
              }),
              0);
    EXPECT_EQ(shown([](Scene& scene, Node node, Renderable) { scene.setVisible(node, false); }), 0);
    EXPECT_EQ(shown([](Scene& scene, Node, Renderable splats) { scene.setLayers(splats, kAllLayers, 0); }), 0);
    EXPECT_EQ(shown([](Scene& scene, Node node, Renderable) { scene.remove(node); }), 0);
    EXPECT_EQ(shown([](Scene& scene, Node, Renderable splats) { scene.remove(splats); }), 0);
}

struct SplatFrame {
    std::vector<std::string> passes;
    uint64_t commands = 0;
    std::string why;
};

SplatFrame frameOf(std::function<void(MaterialStage&)> const& build) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
    MaterialStage stage(*engine);
    build(stage);
    Renderer renderer(*engine);
    const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = stage.view.size }));
    for (int i = 0; i < 4; ++i) renderer.render(stage.scene, stage.view, target);
    engine->waitIdle();
    SplatFrame frame;
    const uint64_t before = engine->statistics().commands;
    renderer.render(stage.scene, stage.view, target);
    engine->waitIdle();
    frame.commands = engine->statistics().commands - before;
    for (EffectDecision const& decision : renderer.decisions()) {
        if (decision.name == "splats") frame.why = decision.reason;
        if (decision.state == EffectDecision::State::Ran) frame.passes.push_back(decision.name);
    }
    test::expectNoErrors(*engine);
    return frame;
}

TEST(Splats, CostNothingWhereNoneAreSeen) {
    const SplatCloud cloud = cloudOf(randomSplats(10, 1), SplatColors::Srgb);
    const SplatFrame without = frameOf([](MaterialStage&) {});
    EXPECT_THAT(without.passes, ElementsAre("color", "tone map"));
    EXPECT_EQ(without.why, "none in the scene");
    const SplatFrame beside = frameOf([&](MaterialStage& stage) {
        stage.scene.add({ .worldFromObject = glm::translate(double4x4(1), double3(0, 0, 99)), .splats = cloud });
    });
    EXPECT_EQ(beside.passes, without.passes);
    EXPECT_EQ(beside.commands, without.commands);
    EXPECT_EQ(beside.why, "none in view");
    const SplatFrame with = frameOf([&](MaterialStage& stage) { stage.scene.add({ .splats = cloud }); });
    EXPECT_THAT(with.passes, ElementsAre("color", "splats", "splat layer", "tone map"));
    EXPECT_EQ(frameOf([&](MaterialStage& stage) {
                  stage.scene.add({ .splats = cloud });
                  stage.view.debugView = DebugView::Normals;
              }).why,
              "a debug view is shown");
}

} // namespace
} // namespace filament_core
