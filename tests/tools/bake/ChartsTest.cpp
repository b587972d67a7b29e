// SPDX-License-Identifier: Apache-2.0
// Charts and their places: nothing lies on anything else, whatever the mesh.
#include "toolkit/paths/Paths.h"
#include "tools/bake/Atlas.h"
#include "tools/bake/BakeModel.h"
#include "tools/bake/Packing.h"
#include "tools/bake/Texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <random>

namespace filament_core::bake {
namespace {

double areaOf(BakeSurface const& surface, uint32_t triangle) {
    const auto corner = [&](uint32_t i) { return surface.positions[surface.indices[triangle * 3 + i]]; };
    return glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
}

/// Triangles at random places, of which some share vertices, some are large, and some have no area.
BakeSurface randomMesh(uint32_t seed, uint32_t triangles) {
    std::minstd_rand random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    BakeSurface surface;
    for (uint32_t i = 0; i < triangles; ++i) {
        const double size = i % 7 == 0 ? 1 : 0.1;
        const double3 center(unit(random), unit(random), unit(random));
        for (int k = 0; k < 3; ++k) {
            const bool sharesVertex = !surface.positions.empty() && random() % 3 == 0;
            if (sharesVertex) {
                surface.indices.push_back(static_cast<uint32_t>(random() % surface.positions.size()));
            } else {
                surface.indices.push_back(static_cast<uint32_t>(surface.positions.size()));
                surface.positions.push_back(center + size * double3(unit(random), unit(random), unit(random)));
            }
        }
        if (i % 11 == 0) surface.indices[i * 3 + 2] = surface.indices[i * 3 + 1];
    }
    return surface;
}

/// A spiral ramp of more than one turn: it overlaps itself in every projection along its axis.
BakeSurface spiral() {
    BakeSurface surface;
    constexpr uint32_t kSteps = 60;
    for (uint32_t i = 0; i <= kSteps; ++i) {
        const double angle = i * 0.25;
        for (const double radius : { 1.0, 2.0 })
            surface.positions.emplace_back(radius * std::cos(angle), i * 0.01, radius * std::sin(angle));
    }
    for (uint32_t i = 0; i < kSteps; ++i) {
        const uint32_t a = 2 * i;
        surface.indices.insert(surface.indices.end(), { a, a + 2, a + 1, a + 1, a + 2, a + 3 });
    }
    return surface;
}

/// By brute force over all pairs of triangles that share a texel: no two overlap, of one chart or of several.
void expectNoOverlap(Atlas const& atlas) {
    struct Placed {
        std::array<double2, 3> corners;
        uint32_t chart;
    };
    std::map<std::pair<int, int>, std::vector<Placed>> cells;
    constexpr double kCell = 8;
    for (uint32_t c = 0; c < atlas.charts.size(); ++c) {
        AtlasChart const& chart = atlas.charts[c];
        for (size_t i = 0; i < chart.chart.triangles.size(); ++i) {
            Placed placed{ {}, c };
            for (size_t k = 0; k < 3; ++k) placed.corners[k] = chart.corner(i * 3 + k, atlas.texelsPerMeter);
            if (doubleArea(placed.corners[0], placed.corners[1], placed.corners[2]) < 1e-6) continue;
            double2 low = placed.corners[0], high = low;
            for (double2 const& p : placed.corners) low = glm::min(low, p), high = glm::max(high, p);
            for (int y = int(low.y / kCell); y <= int(high.y / kCell); ++y) {
                for (int x = int(low.x / kCell); x <= int(high.x / kCell); ++x) {
                    std::vector<Placed>& others = cells[{ x, y }];
                    for (Placed const& other : others)
                        ASSERT_FALSE(overlap(placed.corners, other.corners, 1e-3))
                                << "charts " << c << " and " << other.chart << " at " << x << ", " << y;
                    others.push_back(placed);
                }
            }
        }
    }
}

/// The four texels that bilinear filtering reads at a corner of a chart lie in the box of the chart, at every level.
void expectLevelsInside(AtlasChart const& chart, double2 inside, uint32_t levels) {
    for (uint32_t level = 0; level < levels; ++level) {
        const uint32_t texel = 1u << level;
        for (int axis = 0; axis < 2; ++axis) {
            ASSERT_EQ(chart.place[axis] % texel, 0u);
            ASSERT_EQ(chart.size[axis] % texel, 0u);
            const double first = std::floor(inside[axis] / texel - 0.5 + 1e-9);
            const double last = std::ceil(inside[axis] / texel - 0.5 - 1e-9);
            ASSERT_GE(first, 0) << "level " << level;
            ASSERT_LT(last, double(chart.size[axis] / texel)) << "level " << level;
        }
    }
}

/// Each texel that bilinear filtering of a chart reads belongs to no other chart's box, and lies in the image.
void expectPadding(Atlas const& atlas) {
    std::vector<uint32_t> owner(size_t(atlas.side) * atlas.side * atlas.pages, ~0u);
    for (uint32_t c = 0; c < atlas.charts.size(); ++c) {
        AtlasChart const& chart = atlas.charts[c];
        ASSERT_LE(chart.place.x + chart.size.x, atlas.side);
        ASSERT_LT(chart.place.y / atlas.side, atlas.pages);
        ASSERT_LE(chart.place.y % atlas.side + chart.size.y, atlas.side) << "on one page";
        for (uint32_t y = 0; y < chart.size.y; ++y) {
            for (uint32_t x = 0; x < chart.size.x; ++x) {
                uint32_t& texel = owner[size_t(chart.place.y + y) * atlas.side + chart.place.x + x];
                ASSERT_EQ(texel, ~0u) << "charts " << c << " and " << texel;
                texel = c;
            }
        }
        for (size_t i = 0; i < chart.chart.corners.size(); ++i) {
            const double2 inside = chart.corner(i, atlas.texelsPerMeter) - double2(chart.place);
            ASSERT_GE(std::min(inside.x, inside.y), kPadding - 1e-9);
            ASSERT_LE(inside.x, chart.size.x - kPadding + 1e-6);
            ASSERT_LE(inside.y, chart.size.y - kPadding + 1e-6);
            expectLevelsInside(chart, inside, atlas.levels);
        }
    }
}

void expectEachTriangleOnce(std::span<const BakeSurface> surfaces, Atlas const& atlas, double leastCosine) {
    std::vector<std::vector<int>> seen;
    for (BakeSurface const& surface : surfaces) seen.emplace_back(surface.indices.size() / 3, 0);
    for (AtlasChart const& chart : atlas.charts) {
        for (size_t i = 0; i < chart.chart.triangles.size(); ++i) {
            const uint32_t triangle = chart.chart.triangles[i];
            ++seen[chart.surface][triangle];
            double2 const* const corners = &chart.chart.corners[i * 3];
            const double flat = doubleArea(corners[0], corners[1], corners[2]) / 2;
            const double area = areaOf(surfaces[chart.surface], triangle);
            if (area < 1e-9) continue;
            ASSERT_LE(flat, area * 1.0001);
            ASSERT_GE(flat, area * leastCosine * 0.9999) << "triangle " << triangle;
        }
    }
    for (auto const& counts : seen) {
        for (const int count : counts) ASSERT_EQ(count, 1);
    }
}

void expectWholeAtlas(std::span<const BakeSurface> surfaces, AtlasOptions const& options, jobs::JobSystem& jobs) {
    const Result<Atlas> atlas = makeAtlas(surfaces, options, jobs);
    ASSERT_TRUE(atlas) << atlas.error().message;
    expectEachTriangleOnce(surfaces, *atlas, options.charts.leastCosine);
    expectPadding(*atlas);
    expectNoOverlap(*atlas);
}

TEST(BakeCharts, NothingOverlapsInRandomMeshes) {
    jobs::JobSystem jobs({ .workers = 1 });
    for (uint32_t seed = 1; seed <= 20; ++seed) {
        const BakeSurface surface = randomMesh(seed, 30 * seed);
        const bool hasPages = seed % 2 == 0;
        const AtlasOptions options{ .texelsPerMeter = 20,
                                    .maxSide = hasPages ? 256u : 4096u,
                                    .maxPages = hasPages ? 99u : 1u,
                                    .levels = 1 + seed % kMostLevels };
        expectWholeAtlas({ &surface, 1 }, options, jobs);
        if (HasFatalFailure()) return;
    }
}

TEST(BakeCharts, ASpiralIsCutBeforeItOverlapsItself) {
    jobs::JobSystem jobs({ .workers = 0 });
    const BakeSurface surface = spiral();
    EXPECT_GT(makeCharts(surface.positions, surface.indices).size(), 1u);
    expectWholeAtlas({ &surface, 1 }, { .texelsPerMeter = 16 }, jobs);
}

// Six squares: neighbours turn by a right angle.
TEST(BakeCharts, ABoxHasSixChartsOfItsSides) {
    BakeSurface box;
    for (int i = 0; i < 8; ++i) box.positions.emplace_back(i & 1, (i >> 1) & 1, i >> 2);
    box.indices = { 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5 };
    const std::vector<Chart> charts = makeCharts(box.positions, box.indices);
    ASSERT_EQ(charts.size(), 6u);
    for (Chart const& chart : charts) {
        EXPECT_EQ(chart.triangles.size(), 2u);
        EXPECT_NEAR(chart.size.x, 1, 1e-9);
        EXPECT_NEAR(chart.size.y, 1, 1e-9);
    }
}

TEST(BakeCharts, TrianglesWithoutAnAreaSurvive) {
    BakeSurface surface;
    surface.positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 2, 0, 0 } };
    surface.indices = { 0, 0, 0, 0, 1, 3, 0, 1, 2, 1, 1, 2 };
    jobs::JobSystem jobs({ .workers = 0 });
    const Result<Atlas> atlas = makeAtlas({ &surface, 1 }, { .texelsPerMeter = 8 }, jobs);
    ASSERT_TRUE(atlas) << atlas.error().message;
    for (float2 const& uv : atlas->surfaces[0].uvs) EXPECT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1);
    EXPECT_EQ(atlas->surfaces[0].indices.size(), 12u);

    surface.indices = { 0, 0, 0 };
    EXPECT_TRUE(makeAtlas({ &surface, 1 }, {}, jobs));
    surface.indices.clear();
    EXPECT_TRUE(makeAtlas({ &surface, 1 }, {}, jobs));
}

TEST(BakeCharts, AreTheSameForAnyNumberOfWorkers) {
    std::vector<BakeSurface> surfaces;
    for (uint32_t seed = 1; seed < 9; ++seed) surfaces.push_back(randomMesh(seed, 100));
    jobs::JobSystem none({ .workers = 0 }), some({ .workers = 3 });
    const Result<Atlas> a = makeAtlas(surfaces, {}, none), b = makeAtlas(surfaces, {}, some);
    ASSERT_TRUE(a && b);
    ASSERT_EQ(a->side, b->side);
    for (size_t i = 0; i < surfaces.size(); ++i) EXPECT_EQ(a->surfaces[i].uvs, b->surfaces[i].uvs);
}

TEST(BakeCharts, TheErrorNamesADensityThatFits) {
    const BakeSurface surface = randomMesh(3, 500);
    jobs::JobSystem jobs({ .workers = 0 });
    const Result<Atlas> atlas = makeAtlas({ &surface, 1 }, { .texelsPerMeter = 1e6, .maxSide = 512 }, jobs);
    ASSERT_FALSE(atlas);
    const size_t at = atlas.error().message.find("--density ");
    ASSERT_NE(at, std::string::npos) << atlas.error().message;
    const double density = std::stod(atlas.error().message.substr(at + 10));
    EXPECT_TRUE(makeAtlas({ &surface, 1 }, { .texelsPerMeter = density / 4, .maxSide = 512 }, jobs)) << density;
}

TEST(BakePacking, RectanglesFillMostOfTheImage) {
    std::minstd_rand random(5);
    std::vector<uint2> sizes;
    uint64_t area = 0;
    for (int i = 0; i < 400; ++i) {
        sizes.emplace_back(4 + random() % 60, 4 + random() % 60);
        area += uint64_t(sizes.back().x) * sizes.back().y;
    }
    const std::optional<Packing> packing = packRectangles(sizes, { 4096 });
    ASSERT_TRUE(packing);
    EXPECT_GT(double(area) / (double(packing->side) * packing->side), 0.8);
}

TEST(BakePacking, WhatDoesNotFitIsRefused) {
    const std::vector<uint2> sizes(5, uint2(40, 40));
    EXPECT_FALSE(packRectangles(sizes, { 80 }));
    EXPECT_TRUE(packRectangles(sizes, { 120 }));
    EXPECT_TRUE(packRectangles(sizes, { 80, 2 }));
    EXPECT_FALSE(packRectangles(sizes, { 39, 99 })) << "one is larger than a page";
    EXPECT_FALSE(packRectangles(sizes, { 40, 4 }));
    EXPECT_EQ(packRectangles(sizes, { 40, 5 })->pages, 5u);
}

// Of rectangles that follow each other, as those of a surface do, the first pages hold the first ones.
TEST(BakePacking, PagesAreFewAndFullAndInTheOrderOfTheRectangles) {
    std::minstd_rand random(7);
    std::vector<uint2> sizes;
    double area = 0;
    for (int i = 0; i < 2000; ++i) {
        sizes.emplace_back(8 * (1 + random() % 6), 8 * (1 + random() % 6));
        area += double(sizes.back().x) * sizes.back().y;
    }
    const std::optional<Packing> packing = packRectangles(sizes, { 512, 99 }, 8);
    ASSERT_TRUE(packing);
    EXPECT_LE(packing->side, 512u);
    EXPECT_EQ(packing->side % 8, 0u);
    EXPECT_GT(area / (double(packing->side) * packing->side * packing->pages), 0.8);
    std::vector<bool> taken(size_t(packing->side) * packing->side * packing->pages, false);
    uint32_t page = 0;
    for (size_t i = 0; i < sizes.size(); ++i) {
        const uint2 place = packing->places[i];
        ASSERT_GE(place.y / packing->side, page);
        page = place.y / packing->side;
        ASSERT_EQ((place.y + sizes[i].y - 1) / packing->side, page);
        ASSERT_LE(place.x + sizes[i].x, packing->side);
        for (uint32_t y = place.y; y < place.y + sizes[i].y; ++y) {
            for (uint32_t x = place.x; x < place.x + sizes[i].x; ++x) {
                ASSERT_FALSE(taken[size_t(y) * packing->side + x]) << "rectangle " << i;
                taken[size_t(y) * packing->side + x] = true;
            }
        }
    }
    EXPECT_EQ(page + 1, packing->pages);
}

// A point of the square's inside stands for each texel whose centre lies in it, and borders have their nearest one.
TEST(BakeTexels, OfASquareAreItsGridAndABorder) {
    BakeSurface square;
    square.positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, -1 }, { 0, 0, -1 } };
    square.indices = { 0, 1, 2, 0, 2, 3 };
    jobs::JobSystem jobs({ .workers = 0 });
    const Result<Atlas> atlas = makeAtlas({ &square, 1 }, { .texelsPerMeter = 8 }, jobs);
    ASSERT_TRUE(atlas);
    size_t inside = 0, border = 0;
    for (AtlasTexel const& texel : findTexels(*atlas)) {
        (texel.distance == 0 ? inside : border) += 1;
        const SurfacePoint point = pointOf(square, texel);
        EXPECT_GT(point.faceNormal.y, 0.999);
        EXPECT_TRUE(point.position.x > 0 && point.position.x < 1 && point.position.z < 0 && point.position.z > -1);
    }
    EXPECT_EQ(inside, 64u);
    EXPECT_EQ(border, 4u * 8 + 4);
}

TEST(BakeCharts, NothingOverlapsInModels) {
    const std::filesystem::path folder = tools::assetDir() / "models";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no models at " << folder;
    jobs::JobSystem jobs({ .workers = 1 });
    for (const char* name : { "FlightHelmet/FlightHelmet.gltf", "ShadowsSpot", "SheenChair", "Box-Draco", "BoxMeshopt",
                              "LightsPunctualLamp", "NormalTangentTest", "SpecularTest" }) {
        std::filesystem::path path = folder / name;
        if (std::filesystem::is_directory(path)) {
            for (auto const& file : std::filesystem::recursive_directory_iterator(path)) {
                const std::string type = file.path().extension().string();
                if (type == ".gltf" || type == ".glb") path = file.path();
            }
        }
        if (!std::filesystem::is_regular_file(path)) continue;
        SCOPED_TRACE(path);
        const Result<BakeModel> model = readBakeModel(path, jobs);
        ASSERT_TRUE(model) << model.error().message;
        double area = 0;
        for (BakeSurface const& surface : model->surfaces) {
            for (uint32_t i = 0; i < surface.indices.size() / 3; ++i) area += areaOf(surface, i);
        }
        expectWholeAtlas(model->surfaces, { .texelsPerMeter = 400 / std::sqrt(area), .maxSide = 8192 }, jobs);
        if (HasFatalFailure()) return;
    }
}

} // namespace
} // namespace filament_core::bake
