// SPDX-License-Identifier: Apache-2.0
// The renderer as a whole: determinism, honest errors, agreement of its techniques, alpha, and refusals.
#include "tests/tools/reference/TestScenes.h"

#include <gmock/gmock.h>

namespace filament_core::reference {
namespace {

using ::testing::HasSubstr;

std::shared_ptr<assets::HdrImage> skyWithLamp() {
    return makeSky(32, [](double3 d) {
        const double3 lamp = glm::normalize(double3(0.3, 0.7, 0.5));
        return float3(double3(0.2, 0.3, 0.4) * (1.5 + d.y) + double3(glm::dot(d, lamp) > 0.97 ? 30.0 : 0.0));
    });
}

/// A sphere above a floor under a sky with a lamp, a sun and a point light.
ReferenceScene busyScene(float roughness = 0.4f) {
    auto model = makeModel(spherePrimitive(24), metal(roughness, { 0.9f, 0.6f, 0.3f }));
    model->materials.push_back(lambert(0.5f));
    model->meshes.push_back({ "floor", { floorPrimitive() } });
    model->meshes[1].primitives[0].material = 1;
    model->nodes[0].worldFromNode = double4x4(0.5);
    model->nodes[0].worldFromNode[3] = double4(0, 0.5, 0, 1);
    model->nodes.push_back({ .name = "floor", .mesh = 1 });
    ReferenceScene scene{ .models = { { model } } };
    scene.environment = { .image = skyWithLamp(), .illuminance = Lux{ 1 } };
    scene.suns = { { .directionWorld = { -1, -2, 0 }, .illuminance = Lux{ 2 } } };
    scene.points = { { .positionWorld = { 1, 1, 1 }, .intensity = Candela{ 0.5f } } };
    return scene;
}

const ReferenceView kBusyView = viewFrom({ 2, 1.5, 3 }, { 0, 0.3, 0 }, { 24, 16 }, 40);

TEST(Render, GivesTheSameBitsForAnyNumberOfWorkers) {
    const ReferenceSettings settings{ .samplesPerPixel = 32 };
    const ReferenceImage alone = rendered(busyScene(), kBusyView, settings, 0);
    for (const int workers : { 1, 2, 7 }) {
        const ReferenceImage together = rendered(busyScene(), kBusyView, settings, workers);
        EXPECT_EQ(alone.color, together.color) << workers;
        EXPECT_EQ(alone.standardError, together.standardError) << workers;
        EXPECT_EQ(alone.statistics.rays, together.statistics.rays) << workers;
    }
}

TEST(Render, AnotherSeedGivesAnotherPictureOfTheSameScene) {
    ReferenceSettings settings{ .samplesPerPixel = 64 };
    const ReferenceImage one = rendered(busyScene(), kBusyView, settings);
    settings.seed = 2;
    const ReferenceImage other = rendered(busyScene(), kBusyView, settings);
    EXPECT_NE(one.color, other.color);
    const Estimate a = estimateOf(one), b = estimateOf(other);
    for (int c = 0; c < 3; ++c) {
        EXPECT_LE(std::abs(a.mean[c] - b.mean[c]), 4 * std::hypot(a.error[c], b.error[c]));
    }
}

// The error estimate of one image compared with the spread of 24 images: for the mean over pixels, and pixel by
// pixel.
TEST(Render, StatesTheErrorThatItMakes) {
    ReferenceSettings settings{ .samplesPerPixel = 64 };
    constexpr uint32_t kPictures = 24;
    std::vector<ReferenceImage> pictures;
    for (uint32_t seed = 0; seed < kPictures; ++seed) {
        settings.seed = seed + 10;
        pictures.push_back(rendered(busyScene(), kBusyView, settings));
    }
    double claimed = 0, observed = 0;
    for (size_t pixel = 0; pixel < pictures[0].color.size(); ++pixel) {
        double sum = 0, squares = 0;
        for (ReferenceImage const& picture : pictures) {
            const double value = double(picture.color[pixel].y), error = double(picture.standardError[pixel].y);
            sum += value;
            squares += value * value;
            claimed += error * error;
        }
        observed += (squares - sum * sum / kPictures) * kPictures / (kPictures - 1);
    }
    EXPECT_NEAR(observed / claimed, 1, 0.2);
}

TEST(Render, SamplingTheLightsTheMaterialOrBothHasOneMean) {
    for (const Integrator integrator : { Integrator::Path, Integrator::Unoccluded }) {
        ReferenceSettings settings{ .integrator = integrator, .samplesPerPixel = 256 };
        const ReferenceImage both = rendered(busyScene(), kBusyView, settings);
        for (const Sampling sampling : { Sampling::Bsdf, Sampling::Light }) {
            settings.sampling = sampling;
            const ReferenceImage one = rendered(busyScene(), kBusyView, settings);
            const Estimate a = estimateOf(both), b = estimateOf(one);
            for (int c = 0; c < 3; ++c) {
                EXPECT_LE(std::abs(a.mean[c] - b.mean[c]), 3.5 * std::hypot(a.error[c], b.error[c]));
            }
            EXPECT_GT(b.error.x, 1.2 * a.error.x) << "both together are better than either alone";
        }
    }
}

TEST(Render, MoreSamplesMakeASmallerError) {
    ReferenceSettings settings{ .samplesPerPixel = 32 };
    const double few = rendered(busyScene(), kBusyView, settings).statistics.relativeError;
    settings.samplesPerPixel = 512;
    const double many = rendered(busyScene(), kBusyView, settings).statistics.relativeError;
    EXPECT_LT(many, few / 2.5);
    EXPECT_GT(many, 0);
}

TEST(Render, StopsWhenTheErrorIsSmallEnoughOrWhenItIsTold) {
    ReferenceSettings settings{ .samplesPerPixel = 1u << 14, .relativeError = 0.2f };
    const ReferenceImage image = rendered(busyScene(), kBusyView, settings);
    EXPECT_LE(image.statistics.relativeError, 0.2);
    EXPECT_LT(image.statistics.samplesPerPixel, 1u << 13);
    settings.relativeError = 0;
    jobs::JobSystem jobs({ .workers = 1 });
    std::vector<RenderProgress> calls;
    const auto stopped = render(busyScene(), kBusyView, settings, jobs, [&](RenderProgress const& progress) {
        calls.push_back(progress);
        return calls.size() < 3;
    });
    ASSERT_TRUE(stopped.ok());
    ASSERT_EQ(calls.size(), 3u);
    EXPECT_EQ(stopped->statistics.passes, 3u);
    EXPECT_EQ(calls[2].samplesDone, 3 * calls[0].samplesDone);
    EXPECT_EQ(calls[2].samplesTotal, 1u << 14);
    EXPECT_GT(calls[2].relativeError, 0);
}

TEST(Render, TheOccludedPictureIsDarkerWhereThingsAreNear) {
    ReferenceScene scene = busyScene();
    scene.suns.clear();
    scene.points.clear();
    const ReferenceView contact = viewFrom({ 2, 1.5, 3 }, { 0, 0, 0.05 }, { 8, 8 }, 1);
    ReferenceSettings settings{ .samplesPerPixel = 64, .maxBounces = 1 };
    const Estimate occluded = estimated(scene, contact, settings);
    settings.integrator = Integrator::Unoccluded;
    const Estimate open = estimated(scene, contact, settings);
    EXPECT_LT(occluded.mean.y, 0.7 * open.mean.y);
}

TEST(Render, ABlendedPaneShowsItselfAndWhatIsBehind) {
    // Black except for its emission 2 * 0.25; behind it a glowing floor of 8: 0.5 + 0.75 * 8, through both panes twice.
    auto model = makeModel(floorPrimitive(), lambert(0));
    model->materials[0].emissiveFactor = float3(8);
    assets::MaterialData pane = lambert(0);
    pane.emissiveFactor = float3(2);
    pane.baseColorFactor.w = 0.25f;
    pane.alphaMode = assets::AlphaMode::Blend;
    model->materials.push_back(pane);
    model->meshes.push_back({ "pane", { floorPrimitive() } });
    model->meshes[1].primitives[0].material = 1;
    model->nodes.push_back({ .name = "pane", .mesh = 1 });
    model->nodes[1].worldFromNode[3] = double4(0, 0.5, 0, 1);
    const ReferenceView above = viewFrom({ 0, 4, 0.5 }, { 0, 0, 0 });
    for (const Integrator integrator : { Integrator::Path, Integrator::Unoccluded }) {
        const ReferenceSettings settings{ .integrator = integrator, .samplesPerPixel = 256 };
        expectAgrees(estimated({ .models = { { model } } }, above, settings), double3(0.25 * 2 + 0.75 * 8), 1e-3);
    }
    model->nodes.push_back(model->nodes[1]); // in the same place: both count
    const ReferenceSettings settings{ .samplesPerPixel = 256 };
    expectAgrees(estimated({ .models = { { model } } }, above, settings), double3(0.5 + 0.75 * (0.5 + 0.75 * 8)), 2e-3);
}

TEST(Render, ABlendedPaneLetsItsShareOfTheSunThrough) {
    auto model = makeModel(floorPrimitive(), lambert(0.5f));
    assets::MaterialData pane = lambert(0);
    pane.baseColorFactor.w = 0.25f;
    pane.alphaMode = assets::AlphaMode::Blend;
    model->materials.push_back(pane);
    model->meshes.push_back({ "pane", { floorPrimitive() } });
    model->meshes[1].primitives[0].material = 1;
    model->nodes.push_back({ .name = "pane", .mesh = 1 });
    model->nodes[1].worldFromNode[3] = double4(0, 0.5, 0, 1);
    ReferenceScene scene{ .models = { { model } } };
    scene.suns = { { .directionWorld = { 0, -1, 0 }, .illuminance = Lux{ 1 } } };
    ReferenceSettings settings{ .samplesPerPixel = 16, .maxBounces = 1 };
    settings.bsdf = { .coupling = CouplingTerm::Never, .lobes = LobeChoice::Diffuse };
    const Estimate estimate = estimated(scene, viewFrom({ 5, 0.3, 0 }, { 0, 0, 0 }), settings);
    expectAgrees(estimate, double3(0.75 * 0.5 / kPiExact), 1e-5);
}

TEST(Render, TheCameraDoesNotSeeSingleSidedSurfacesFromBehind) {
    assets::MaterialData glowing = lambert(0);
    glowing.emissiveFactor = float3(3);
    ReferenceScene scene{ .models = { { makeModel(floorPrimitive(), glowing) } } };
    ReferenceView below = viewFrom({ 0, -4, 0.5 }, { 0, 0, 0 });
    below.clearColor = { 0.25f, 0.5f, 0.75f, 1 };
    const ReferenceSettings settings{ .samplesPerPixel = 4 };
    expectAgrees(estimated(scene, below, settings), double3(0.25, 0.5, 0.75), 1e-6);
    glowing.doubleSided = true;
    scene.models = { { makeModel(floorPrimitive(), glowing) } };
    expectAgrees(estimated(scene, below, settings), double3(3), 1e-6);
}

TEST(Render, MaskedTexelsAreHolesForEyesAndForLight) {
    // The left half of the pane is cut away.
    auto model = makeModel(floorPrimitive(), lambert(0.5f));
    assets::MaterialData pane = lambert(0.5f);
    pane.alphaMode = assets::AlphaMode::Mask;
    pane.baseColor = { .image = 0, .sampler = {} };
    model->images.push_back({ .width = 2, .height = 1, .data = {} });
    for (const int component : { 255, 255, 255, 0, 255, 255, 255, 255 }) {
        model->images[0].data.push_back(static_cast<std::byte>(component));
    }
    model->materials.push_back(pane);
    model->meshes.push_back({ "pane", { floorPrimitive() } });
    model->meshes[1].primitives[0].material = 1;
    model->nodes.push_back({ .name = "pane", .mesh = 1 });
    model->nodes[1].worldFromNode[3] = double4(0, 0.5, 0, 1);
    ReferenceScene scene{ .models = { { model } } };
    scene.suns = { { .directionWorld = { 0, -1, 0 }, .illuminance = Lux{ 1 } } };
    const ReferenceSettings settings{ .samplesPerPixel = 16, .maxBounces = 1 };
    EXPECT_GT(estimated(scene, viewFrom({ -0.5, 0.4, 3 }, { -0.5, 0, 0 }), settings).mean.x, 0.1);
    EXPECT_EQ(estimated(scene, viewFrom({ 0.5, 0.4, 3 }, { 0.5, 0, 0 }), settings).mean.x, 0);
}

TEST(Render, TheSkyIsBehindEverythingOnlyIfItIsAskedFor) {
    ReferenceScene scene;
    scene.environment = uniformSky(0.5f);
    ReferenceView view = viewFrom({ 0, 0, 0 }, { 1, 0, 0 });
    const ReferenceSettings settings{ .samplesPerPixel = 4 };
    expectAgrees(estimated(scene, view, settings), double3(0.5), 1e-6);
    scene.environment->skybox = false;
    view.clearColor = { 0.1f, 0.2f, 0.3f, 1 };
    expectAgrees(estimated(scene, view, settings), double3(0.1, 0.2, 0.3), 1e-6);
}

TEST(Render, APixelShowsWhatTheEnginesProjectionPutsThere) {
    // A small glowing square up and to the right, at pixels that the projection matrix names.
    assets::MaterialData glowing = lambert(0);
    glowing.emissiveFactor = float3(1);
    glowing.doubleSided = true;
    auto model = makeModel(floorPrimitive(), glowing);
    const double4x4 place(double4(0.1, 0, 0, 0), double4(0, 0, 0.1, 0), double4(0, 0.1, 0, 0),
                          double4(0.5, 0.3, -2, 1));
    model->nodes[0].worldFromNode = place;
    ReferenceView view = viewFrom({ 0, 0, 1 }, { 0, 0, 0 }, { 64, 32 }, 30);
    const ReferenceImage image =
            rendered({ .models = { { model } } }, view, { .samplesPerPixel = 64, .filter = PixelFilter::Center });
    double2 centre(0.0);
    double sum = 0;
    for (uint32_t y = 0; y < 32; ++y) {
        for (uint32_t x = 0; x < 64; ++x) {
            const double value = double(image.color[y * 64 + x].x);
            centre += double2(x + 0.5, y + 0.5) * value;
            sum += value;
        }
    }
    ASSERT_GT(sum, 0);
    const float4 clip = view.camera.clipFromView(2) * float4(0.5f, 0.3f, -3, 1);
    const double2 expected((double(clip.x / clip.w) + 1) / 2 * 64, (double(clip.y / clip.w) + 1) / 2 * 32);
    EXPECT_NEAR(centre.x / sum, expected.x, 0.05);
    EXPECT_NEAR(centre.y / sum, expected.y, 0.05);
}

TEST(Render, FarFromTheOriginThePictureIsTheSame) {
    const double3 far(3e6, -2e6, 5e6);
    ReferenceScene scene = busyScene();
    ReferenceSettings settings{ .samplesPerPixel = 16 };
    settings.filter = PixelFilter::Center;
    const ReferenceImage here = rendered(scene, kBusyView, settings);
    scene.models[0].worldFromModel[3] = double4(far, 1);
    scene.points[0].positionWorld += far;
    ReferenceView view = kBusyView;
    view.camera.worldFromView[3] += double4(far, 0);
    const ReferenceImage there = rendered(scene, view, settings);
    double difference = 0;
    for (size_t i = 0; i < here.color.size(); ++i) difference += double(glm::length(here.color[i] - there.color[i]));
    EXPECT_LT(difference / static_cast<double>(here.color.size()), 1e-3 * estimateOf(here).mean.y);
}

TEST(Render, RefusesWhatItCannotDoInOneLine) {
    jobs::JobSystem jobs({ .workers = 0 });
    const auto refusal = [&](ReferenceScene const& scene, ReferenceView const& view,
                             ReferenceSettings const& settings) {
        const auto image = render(scene, view, settings, jobs);
        EXPECT_FALSE(image.ok());
        if (image) return std::string();
        EXPECT_EQ(image.error().code, ErrorCode::InvalidArgument);
        return image.error().message;
    };
    const ReferenceScene empty;
    const ReferenceView view = viewFrom({ 0, 0, 1 }, { 0, 0, 0 });
    ReferenceView flat = view;
    flat.size.y = 0;
    EXPECT_THAT(refusal(empty, flat, {}), HasSubstr("height"));
    EXPECT_THAT(refusal(empty, view, { .samplesPerPixel = 0 }), HasSubstr("samples per pixel"));
    EXPECT_THAT(refusal(empty, view, { .maxBounces = 0 }), HasSubstr("bounces"));
    EXPECT_THAT(refusal(empty, view, { .relativeError = std::nanf("") }), HasSubstr("relative error"));
    ReferenceScene bad;
    bad.models.push_back({});
    EXPECT_THAT(refusal(bad, view, {}), HasSubstr("model"));
    bad.models.clear();
    bad.environment = ReferenceEnvironment{};
    EXPECT_THAT(refusal(bad, view, {}), HasSubstr("environment"));
    bad.environment.reset();
    bad.suns = { { .directionWorld = { 0, 0, 0 } } };
    EXPECT_THAT(refusal(bad, view, {}), HasSubstr("light"));
    bad.suns.clear();
    bad.points = { { .intensity = Candela{ -1 } } };
    EXPECT_THAT(refusal(bad, view, {}), HasSubstr("light"));
}

TEST(Render, LinesAndPointsAreNamedAndLeftOut) {
    auto model = makeModel(floorPrimitive(), lambert(0.5f));
    model->meshes[0].primitives.push_back(model->meshes[0].primitives[0]);
    model->meshes[0].primitives[1].topology = backend::PrimitiveType::Lines;
    jobs::JobSystem jobs({ .workers = 0 });
    const auto traced = prepare({ .models = { { model } } }, jobs);
    ASSERT_TRUE(traced.ok());
    ASSERT_EQ(warnings(**traced).size(), 1u);
    EXPECT_THAT(warnings(**traced)[0], HasSubstr("lines or points"));
}

TEST(Render, LightsOfAModelShineWhereItsNodesPutThem) {
    auto model = makeModel(floorPrimitive(), lambert(0.5f));
    model->lights = { { .type = assets::LightType::Point, .intensity = 7 },
                      { .type = assets::LightType::Directional, .intensity = 2 } };
    model->nodes.push_back({ .name = "bulb", .light = 0 });
    model->nodes.back().worldFromNode[3] = double4(0, 2, 0, 1);
    ReferenceSettings settings{ .samplesPerPixel = 64 };
    settings.bsdf = { .coupling = CouplingTerm::Never, .lobes = LobeChoice::Diffuse };
    const ReferenceView view = viewFrom({ 0, 4, 4 }, { 0, 0, 0 }, { 8, 8 }, 0.02f);
    expectAgrees(estimated({ .models = { { model } } }, view, settings), double3(0.5 / kPiExact * 7 / 4), 1e-5);
    model->nodes.push_back({ .name = "sun", .light = 1 }); // along -Z of a node turned so that -Z is down
    model->nodes.back().worldFromNode =
            double4x4(double4(1, 0, 0, 0), double4(0, 0, -1, 0), double4(0, 1, 0, 0), double4(0, 0, 0, 1));
    expectAgrees(estimated({ .models = { { model } } }, view, settings), double3(0.5 / kPiExact * (7.0 / 4 + 2)), 1e-4);
}

TEST(ModelBounds, AreThoseThatTheEngineFitsIntoTheUnitCube) {
    auto model = makeModel(floorPrimitive(), lambert(1));
    const double c = std::cos(0.5), s = std::sin(0.5);
    model->nodes[0].worldFromNode =
            double4x4(double4(c, 0, -s, 0), double4(0, 1, 0, 0), double4(s, 0, c, 0), double4(3, 4, 5, 1));
    const Box box = modelBounds(*model);
    EXPECT_NEAR(box.min.x, 3 - (c + s), 1e-6) << "the box of the turned box, not of the turned points";
    EXPECT_NEAR(box.max.z, 5 + (c + s), 1e-6);
    EXPECT_EQ(box.min.y, 4);
    EXPECT_TRUE(modelBounds({}).empty());
}

} // namespace
} // namespace filament_core::reference
