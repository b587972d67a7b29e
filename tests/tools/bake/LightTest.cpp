// SPDX-License-Identifier: Apache-2.0
// Baked light beside closed forms, and what must not change it.
#include "tests/tools/reference/TestScenes.h"
#include "tools/bake/BakeLight.h"
#include "tools/bake/Journal.h"
#include "tools/bake/LightmapImage.h"
#include "tools/reference/TracedScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace filament_core::bake {
namespace {

using reference::kPiExact;
using reference::ReferenceScene;

/// Without a specular lobe: KHR_materials_specular with factor 0.
assets::MaterialData pureLambert(float albedo) {
    assets::MaterialData material = reference::lambert(albedo);
    material.specular.factor = 0;
    return material;
}

/// A square of the plane y = 0 with its front up, around `center`.
BakeSurface floorSurface(double halfSide, double3 center = double3(0.0)) {
    BakeSurface surface;
    for (const double2 at : { double2(-1, 1), double2(1, 1), double2(1, -1), double2(-1, -1) })
        surface.positions.push_back(center + halfSide * double3(at.x, 0, at.y));
    surface.indices = { 0, 1, 2, 0, 2, 3 };
    return surface;
}

struct Baked {
    Atlas atlas;
    std::vector<AtlasTexel> texels;
    std::vector<TexelLight> lights;
};

Baked bake(ReferenceScene const& scene, BakeSurface const& surface, double density, LightSettings const& settings,
           int workers = 1) {
    jobs::JobSystem jobs({ .workers = workers });
    Baked baked;
    Result<Atlas> atlas = makeAtlas({ &surface, 1 }, { .texelsPerMeter = density }, jobs);
    EXPECT_TRUE(atlas);
    baked.atlas = std::move(*atlas);
    baked.texels = findTexels(baked.atlas);
    const Result<reference::TracedScenePtr> traced = reference::prepare(scene, jobs);
    EXPECT_TRUE(traced) << traced.error().message;
    bakeTexels(**traced, { &surface, 1 }, baked.atlas, baked.texels, settings, jobs,
               [&](size_t, std::span<const TexelLight> lights) {
                   baked.lights.insert(baked.lights.end(), lights.begin(), lights.end());
                   return true;
               });
    return baked;
}

LightSettings plain(uint32_t samples) { return { .samplesPerTexel = samples, .exposure = reference::plainExposure() }; }

/// A vertical wall at x = `distance`, from z = -width to width and y = 0 to height, facing -x.
assets::PrimitiveData wallPrimitive(float distance, float width, float height) {
    const float3 normal(-1, 0, 0), tangent(0, 0, 1);
    const reference::TestVertex vertices[4] = { { { distance, 0, -width }, normal, tangent, {} },
                                                { { distance, 0, width }, normal, tangent, {} },
                                                { { distance, height, width }, normal, tangent, {} },
                                                { { distance, height, -width }, normal, tangent, {} } };
    const uint32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    return reference::makePrimitive(vertices, indices);
}

// E = pi L: every direction of a uniform sky counts by its cosine.
TEST(BakeLight, OfAFloorUnderAUniformSkyIsPiL) {
    ReferenceScene scene{ .models = { { reference::makeModel(reference::floorPrimitive(), pureLambert(0.5f)) } } };
    scene.environment = reference::uniformSky(2);
    const Baked baked = bake(scene, floorSurface(1), 4, plain(1024));
    ASSERT_GE(baked.lights.size(), 64u);
    for (TexelLight const& light : baked.lights) {
        EXPECT_NEAR(light.irradiance.x, 2 * kPiExact, 4 * light.standardError.x + 2e-3);
        EXPECT_EQ(light.openness, 1);
        EXPECT_EQ(light.backs, 0);
    }
}

// The same from 1e-6 to 1e6 candela / m2, and for texels of a micrometre.
TEST(BakeLight, OfAUniformSkyIsPiLWhateverItsScale) {
    for (const float radiance : { 1e-6f, 1.0f, 1e6f }) {
        for (const double meters : { 1e-6, 0.1 }) {
            ReferenceScene scene{ .models = {
                                          { reference::makeModel(reference::floorPrimitive(), pureLambert(0.5f)) } } };
            scene.environment = reference::uniformSky(radiance);
            const Baked baked = bake(scene, floorSurface(2 * meters), 1 / meters, plain(1024));
            ASSERT_EQ(baked.lights.size(), 4u * 4 + 4 * 4 + 4);
            for (TexelLight const& light : baked.lights)
                EXPECT_NEAR(light.irradiance.x / double(radiance), kPiExact,
                            4 * light.standardError.x / double(radiance) + 2e-3);
            const LightmapImage image = makeImage(baked.atlas, baked.texels, baked.lights);
            const double stored = double(lookUp(halvesOf(image), double2(4.0)).x) * image.intensity;
            EXPECT_NEAR(stored / double(radiance), kPiExact, 0.05);
        }
    }
}

// Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", C-3: a differential element at the foot of the
// normal through the corner of a perpendicular rectangle of height a and width b, at distance c. Here two of them.
double factorOfWall(double height, double halfWidth, double distance) {
    const double y = std::sqrt(height * height + distance * distance);
    const double half = (std::atan(halfWidth / distance) - distance / y * std::atan(halfWidth / y)) / (2 * kPiExact);
    return 2 * half;
}

// A wall of albedo rho under a sky of radiance L, with nothing else in the scene, has radiance rho L; it hides its
// factor F of the floor's sky: E = pi L (1 - F (1 - rho)).
TEST(BakeLight, BesideAWallIsLessByItsFactorAndAlbedo) {
    constexpr double kHeight = 2, kWidth = 3, kDistance = 0.5;
    const double factor = factorOfWall(kHeight, kWidth, kDistance);
    EXPECT_GT(factor, 0.2);
    for (const float albedo : { 0.0f, 0.4f, 1.0f }) {
        ReferenceScene scene{
            .models = { { reference::makeModel(wallPrimitive(kDistance, kWidth, kHeight), pureLambert(albedo)) } }
        };
        scene.environment = reference::uniformSky(1);
        const Baked baked = bake(scene, floorSurface(0.002), 250, plain(16384));
        double3 mean(0.0);
        double error = 0;
        for (TexelLight const& light : baked.lights) {
            mean += light.irradiance / double(baked.lights.size());
            error = std::max(error, light.standardError.x);
            EXPECT_NEAR(light.openness, 1 - factor, 0.02);
        }
        EXPECT_NEAR(mean.x, kPiExact * (1 - factor * (1 - double{ albedo })), 3 * error + 2e-3) << albedo;
        EXPECT_LT(error, 0.03);
    }
}

// In a closed box whose walls all emit M and reflect rho, each sees the same everywhere: E = pi M / (1 - rho).
TEST(BakeLight, InAClosedGlowingBoxIsTheSumOfAllBounces) {
    constexpr float kEmission = 0.25f, kAlbedo = 0.6f;
    assets::MaterialData walls = pureLambert(kAlbedo);
    walls.emissiveFactor = float3(kEmission);
    const ReferenceScene scene{ .models = { { reference::makeModel(reference::roomPrimitive(), walls) } } };
    const Baked baked = bake(scene, floorSurface(0.5, { 0, -1, 0 }), 4, plain(1024));
    double mean = 0, squares = 0;
    for (TexelLight const& light : baked.lights) {
        mean += light.irradiance.x / double(baked.lights.size());
        squares += light.standardError.x * light.standardError.x;
        EXPECT_EQ(light.openness, 0);
    }
    const double error = std::sqrt(squares) / double(baked.lights.size());
    EXPECT_NEAR(mean, kPiExact * double{ kEmission } / (1 - double{ kAlbedo }), 4 * error);
    EXPECT_LT(error, 0.02);
}

// The sun's own light is what the engine adds itself, unless it is asked for: lux times the cosine.
TEST(BakeLight, OfTheSunItselfIsLeftToTheEngineUnlessAskedFor) {
    ReferenceScene scene{ .models = { { reference::makeModel(reference::floorPrimitive(), pureLambert(0.5f)) } } };
    scene.suns.push_back({ .directionWorld = float3(0.6f, -0.8f, 0), .illuminance = Lux{ 1000 } });
    LightSettings settings = plain(32);
    const Baked without = bake(scene, floorSurface(1), 2, settings);
    for (TexelLight const& light : without.lights) EXPECT_EQ(light.irradiance, double3(0.0));
    settings.directLight = true;
    const Baked with = bake(scene, floorSurface(1), 2, settings);
    for (TexelLight const& light : with.lights) EXPECT_NEAR(light.irradiance.y, 800, 0.01);
}

ReferenceScene roomUnderSky() {
    ReferenceScene scene{ .models = { { reference::makeModel(reference::floorPrimitive(), reference::lambert(0.7f)) },
                                      { reference::makeModel(wallPrimitive(1, 1, 2), reference::lambert(0.8f)) } } };
    scene.environment = reference::ReferenceEnvironment{
        .image = reference::makeSky(32, [](double3 d) { return float3(d.y > 0.9    ? 30.0f
                                                                      : d.x < -0.5 ? 2.0f
                                                                                   : 0.3f); }),
        .illuminance = Lux{ 1 }
    };
    return scene;
}

// Two standard errors contain the difference from a bake of thirty times the samples, for 95 % of the texels.
TEST(BakeLight, StatedErrorsHoldAgainstManySamples) {
    const ReferenceScene scene = roomUnderSky();
    const Baked few = bake(scene, floorSurface(0.98), 10, plain(256));
    LightSettings settings = plain(8192);
    settings.seed = 77;
    const Baked many = bake(scene, floorSurface(0.98), 10, settings);
    size_t held = 0;
    for (size_t i = 0; i < few.lights.size(); ++i) {
        const double error = std::hypot(few.lights[i].standardError.y, many.lights[i].standardError.y);
        held += std::abs(few.lights[i].irradiance.y - many.lights[i].irradiance.y) <= 2 * error;
    }
    const double part = double(held) / double(few.lights.size());
    RecordProperty("held", std::to_string(part));
    EXPECT_GE(part, 0.95) << held << " of " << few.lights.size();
    EXPECT_LT(part, 0.995) << "the errors are too large to say anything";
}

TEST(BakeLight, StopsATexelAtItsError) {
    LightSettings settings = plain(4096);
    settings.relativeError = 0.02;
    const Baked baked = bake(roomUnderSky(), floorSurface(0.98), 3, settings);
    uint32_t least = ~0u, most = 0;
    for (TexelLight const& light : baked.lights) {
        least = std::min(least, light.samples), most = std::max(most, light.samples);
        if (light.samples == 4096) continue;
        EXPECT_LE(light.standardError.x, 0.0201 * light.irradiance.x);
    }
    EXPECT_LT(least, most);
}

bool areSame(std::vector<TexelLight> const& a, std::vector<TexelLight> const& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(TexelLight)) == 0;
}

TEST(BakeLight, HasTheSameBitsForAnyNumberOfWorkers) {
    const ReferenceScene scene = roomUnderSky();
    const Baked none = bake(scene, floorSurface(0.98), 4, plain(32), 0);
    for (const int workers : { 1, 3 })
        EXPECT_TRUE(areSame(none.lights, bake(scene, floorSurface(0.98), 4, plain(32), workers).lights));
}

// A box without a bottom on the floor: the floor inside of it sees the backs of its sides.
TEST(BakeLight, InsideOfABoxIsFilledFromOutside) {
    BakeSurface floor = floorSurface(2, { 0, -1, 0 });
    assets::PrimitiveData box = reference::roomPrimitive();
    std::vector<uint32_t> indices(box.indices.size() / 4);
    std::memcpy(indices.data(), box.indices.data(), box.indices.size());
    for (size_t i = 0; i + 2 < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]); // faces outwards
    std::memcpy(box.indices.data(), indices.data(), box.indices.size());
    ReferenceScene scene{ .models = { { reference::makeModel(std::move(box), pureLambert(0.5f)) } } };
    scene.environment = reference::uniformSky(1);
    const Baked baked = bake(scene, floor, 4, plain(64));
    const LightmapImage image = makeImage(baked.atlas, baked.texels, baked.lights);
    EXPECT_NEAR(double(image.hidden), 64, 20);
    for (size_t i = 0; i < baked.texels.size(); ++i) {
        const double4 texel = image.texels[size_t(baked.texels[i].y) * image.side + baked.texels[i].x];
        EXPECT_GT(texel.x, 0.5) << baked.texels[i].x << ", " << baked.texels[i].y;
    }
}

// A poster a millimetre over the floor, seen from both sides: the floor below it is as bright as beside it.
TEST(BakeLight, WhatAThinBoardCoversIsFilledFromBeside) {
    const BakeSurface floor = floorSurface(2, { 0, -1, 0 });
    const float3 up(0, 1, 0), side(1, 0, 0);
    const reference::TestVertex corners[4] = { { { -0.5f, -0.999f, 0.5f }, up, side, {} },
                                               { { 0.5f, -0.999f, 0.5f }, up, side, {} },
                                               { { 0.5f, -0.999f, -0.5f }, up, side, {} },
                                               { { -0.5f, -0.999f, -0.5f }, up, side, {} } };
    const uint32_t triangles[6] = { 0, 1, 2, 0, 2, 3 };
    assets::PrimitiveData poster = reference::makePrimitive(corners, triangles);
    assets::MaterialData paper = pureLambert(0.5f);
    paper.doubleSided = true;
    ReferenceScene scene{ .models = { { reference::makeModel(std::move(poster), paper) } } };
    scene.environment = reference::uniformSky(1);
    const Baked baked = bake(scene, floor, 4, plain(64));
    const LightmapImage image = makeImage(baked.atlas, baked.texels, baked.lights);
    EXPECT_NEAR(double(image.hidden), 16, 4);
    for (size_t i = 0; i < baked.texels.size(); ++i) {
        const double4 texel = image.texels[size_t(baked.texels[i].y) * image.side + baked.texels[i].x];
        EXPECT_GT(texel.x, 2.5) << baked.texels[i].x << ", " << baked.texels[i].y;
    }
}

// The brightest texel lies between 2^13 and 2^14 of the intensity, whatever its lux: 1e-6 as well as 1e6.
TEST(LightmapImage, KeepsTenBitsOfDimAndOfBrightLight) {
    jobs::JobSystem jobs({ .workers = 0 });
    const BakeSurface surface = floorSurface(1);
    const Result<Atlas> atlas = makeAtlas({ &surface, 1 }, { .texelsPerMeter = 2 }, jobs);
    ASSERT_TRUE(atlas);
    const std::vector<AtlasTexel> texels = findTexels(*atlas);
    for (const double lux : { 1e-6, 1.0, 3.14159, 1e6 }) {
        std::vector<TexelLight> lights(texels.size(), TexelLight{ .irradiance = double3(lux), .openness = 0.5 });
        const LightmapImage image = makeImage(*atlas, texels, lights);
        const double stored = lux / image.intensity;
        EXPECT_GE(stored, 8192);
        EXPECT_LT(stored, 16384);
        const assets::Image halves = halvesOf(image);
        EXPECT_EQ(halves.format, backend::Format::RGBA16F);
        EXPECT_EQ(halves.data.size(), size_t(image.side) * image.side * 8);
    }
}

// Two floors of one texel a metre, one twice as bright: what a level has of a chart is the light of that chart alone,
// and the mean of what was traced on the surface.
TEST(LightmapImage, SmallerLevelsKnowTheirOwnChartAlone) {
    jobs::JobSystem jobs({ .workers = 0 });
    const std::array surfaces{ floorSurface(5), floorSurface(11) };
    const Result<Atlas> atlas = makeAtlas(surfaces, { .texelsPerMeter = 1, .levels = 5 }, jobs);
    ASSERT_TRUE(atlas);
    const std::vector<AtlasTexel> texels = findTexels(*atlas);
    std::vector<TexelLight> lights;
    for (AtlasTexel const& texel : texels) {
        // beyond the border, and where backs are seen, is a light that no level may show
        const double lux = texel.distance > 0 || texel.x % 3 == 0 ? 1000 : texel.chart == 0 ? 1 : 2;
        lights.push_back({ .irradiance = double3(lux), .openness = 0.5, .backs = texel.x % 3 == 0 ? 1.0 : 0.0 });
    }
    const LightmapImage image = makeImage(*atlas, texels, lights);
    ASSERT_EQ(image.smaller.size(), 4u);
    for (uint32_t level = 1; level < 5; ++level) {
        const uint32_t width = image.side >> level;
        ASSERT_EQ(image.smaller[level - 1].size(), size_t(width) * width);
        for (AtlasTexel const& texel : texels) {
            if (texel.distance > 0 || texel.x % 3 == 0) continue;
            const double4 value = image.smaller[level - 1][size_t(texel.y >> level) * width + (texel.x >> level)];
            EXPECT_NEAR(value.x, texel.chart == 0 ? 1 : 2, 1e-12) << "level " << level;
            EXPECT_NEAR(value.w, 0.5, 1e-12);
        }
    }
    const assets::Image halves = halvesOf(image);
    EXPECT_EQ(halves.levels, 5u);
    EXPECT_EQ(halves.data.size(), halves.levelOffset(5));
}

// Each texel of a look-up has the colour of its chart, and each level one of its own.
TEST(LightmapImage, ShowsChartsAndLevelsAsColours) {
    jobs::JobSystem jobs({ .workers = 0 });
    const std::array surfaces{ floorSurface(5), floorSurface(11) };
    const Result<Atlas> atlas = makeAtlas(surfaces, { .texelsPerMeter = 1, .levels = 3 }, jobs);
    ASSERT_TRUE(atlas);
    const LightmapImage image = makeChartImage(*atlas, 100);
    std::array<double3, 2> hues{ double3(0.0), double3(0.0) };
    for (AtlasTexel const& texel : findTexels(*atlas)) {
        if (texel.distance > 0) continue;
        const double3 color(image.texels[size_t(texel.y) * image.side + texel.x]);
        double3& hue = hues[texel.chart];
        if (hue == double3(0.0)) hue = glm::normalize(color);
        EXPECT_NEAR(glm::dot(glm::normalize(color), hue), 1, 1e-9);
    }
    EXPECT_LT(glm::dot(hues[0], hues[1]), 0.95);
    ASSERT_EQ(image.smaller.size(), 2u);
    EXPECT_EQ(double3(image.smaller[0][0]), double3(200, 0, 0));
    EXPECT_EQ(image.smaller[1].size(), image.texels.size() / 16);
    EXPECT_LT(200 / image.intensity, std::ldexp(1.0, kTopExponent));
}

class JournalTest : public ::testing::Test {
protected:
    void SetUp() override {
        mFolder = std::filesystem::temp_directory_path() /
                  ("filament_bake_journal_" +
                   std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::remove_all(mFolder);
        std::filesystem::create_directories(mFolder);
        for (size_t i = 0; i < 100; ++i)
            mLights.push_back({ .irradiance = double3(double(i)), .samples = static_cast<uint32_t>(i) });
    }
    void TearDown() override { std::filesystem::remove_all(mFolder); }

    void write(std::filesystem::path const& file, RecordRange range, size_t most = ~size_t(0)) {
        Result<Journal> journal = Journal::open(file, { 42, range, sizeof(TexelLight) });
        ASSERT_TRUE(journal) << journal.error().message;
        size_t at = journal->count();
        for (; at < std::min<size_t>(range.count, most); at += 10)
            ASSERT_TRUE(journal->append(std::as_bytes(
                    std::span(mLights).subspan(range.first + at, std::min<size_t>(10, range.count - at)))));
    }

    std::filesystem::path mFolder;
    std::vector<TexelLight> mLights;
};

// Killed at any byte: what was whole stays, and the end is that of a run that nothing stopped.
TEST_F(JournalTest, ContinuesAfterAKillAtAnyByte) {
    const std::filesystem::path file = mFolder / "a.part";
    write(file, { 0, 100 });
    const auto size = std::filesystem::file_size(file);
    for (uintmax_t cut = 40; cut < size; cut += 97) {
        std::filesystem::copy_file(file, mFolder / "b.part", std::filesystem::copy_options::overwrite_existing);
        std::filesystem::resize_file(mFolder / "b.part", cut);
        write(mFolder / "b.part", { 0, 100 });
        const Result<JournalPart> part = readJournal(mFolder / "b.part");
        ASSERT_TRUE(part);
        ASSERT_TRUE(areSame(valuesOf<TexelLight>(part->records), mLights)) << cut;
    }
}

TEST_F(JournalTest, PartsMergeToTheWholeInAnyOrder) {
    std::vector<std::filesystem::path> files;
    for (uint32_t i = 0; i < 3; ++i) {
        files.push_back(mFolder / std::to_string(i));
        write(files.back(), rangeOfPart(100, i, 3));
    }
    std::ranges::reverse(files);
    const JournalHeader whole{ 42, { 0, 100 }, sizeof(TexelLight) };
    const Result<std::vector<std::byte>> merged = mergeJournals(files, whole);
    ASSERT_TRUE(merged) << merged.error().message;
    EXPECT_TRUE(areSame(valuesOf<TexelLight>(*merged), mLights));

    files.pop_back();
    EXPECT_FALSE(mergeJournals(files, whole));
    EXPECT_FALSE(mergeJournals(files, { 43, { 0, 100 }, sizeof(TexelLight) }));
}

TEST_F(JournalTest, RefusesWhatIsNotItsOwn) {
    write(mFolder / "a.part", { 0, 100 }, 50);
    EXPECT_FALSE(Journal::open(mFolder / "a.part", { 43, { 0, 100 }, sizeof(TexelLight) }));
    EXPECT_FALSE(Journal::open(mFolder / "a.part", { 42, { 0, 99 }, sizeof(TexelLight) }));
    std::ofstream(mFolder / "b.part") << "something else entirely, that must not be lost";
    EXPECT_FALSE(Journal::open(mFolder / "b.part", { 42, { 0, 100 }, sizeof(TexelLight) }));
    EXPECT_EQ(std::filesystem::file_size(mFolder / "b.part"), 46u);
    const auto other = mergeJournals(std::vector{ mFolder / "b.part" }, { 42, { 0, 100 }, sizeof(TexelLight) });
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().message.find("delete"), std::string::npos) << "it may be somebody's model";
    const Result<std::vector<std::byte>> merged =
            mergeJournals(std::vector{ mFolder / "a.part" }, { 42, { 0, 100 }, sizeof(TexelLight) });
    ASSERT_FALSE(merged);
    EXPECT_NE(merged.error().message.find("is not finished"), std::string::npos);
}

} // namespace
} // namespace filament_core::bake
