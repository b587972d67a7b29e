// SPDX-License-Identifier: Apache-2.0
#include "toolkit/showcase/Showcase.h"

#include "filament_core/assets/environment/AnalyticSky.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/showcase/SceneBuilder.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace filament_core::showcase {
namespace {

using assets::AlphaMode;
using assets::MaterialData;

constexpr float3 kTowardsSun{ -0.55f, 0.62f, 0.56f }; // from the left, over the camera's shoulder
constexpr float kSkyUnit = 22;                        // klx: radiance 1 of the sky's file
constexpr uint32_t kTextureSize = 256;                // an exhibit covers about 90 pixels of a 720p frame

/// The images of all exhibits, in the order of `kTextureSets`.
enum Set { Brick, Wood, Terrazzo, Checker, Dimple, Lattice, StainedGlass, Lava, Brushed, SetCount };

struct NamedTextures {
    const char* name;
    TextureSet (*make)(uint32_t size);
};

constexpr NamedTextures kTextureSets[SetCount] = { { "brick", brickTextures },
                                                   { "wood", woodTextures },
                                                   { "terrazzo", terrazzoTextures },
                                                   { "checker", checkerTextures },
                                                   { "dimple", dimpleTextures },
                                                   { "lattice", latticeTextures },
                                                   { "stained glass", stainedGlassTextures },
                                                   { "lava", lavaTextures },
                                                   { "brushed", brushedTextures } };

using Images = std::array<TextureSetImages, SetCount>;

Result<Images> addAllPictures(SceneBuilder& scene, jobs::JobSystem& jobs) {
    std::array<TextureSet, SetCount> sets;
    jobs::parallelFor<"texture">(jobs, SetCount, 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) sets[i] = kTextureSets[i].make(kTextureSize);
    });
    Images images;
    for (size_t i = 0; i < SetCount; ++i) {
        Result<TextureSetImages> added = scene.addPictures(kTextureSets[i].name, sets[i]);
        if (!added) return added.error();
        images[i] = *added;
    }
    return images;
}

MaterialData plain(std::string name, float3 color, float metallic, float roughness) {
    return { .name = std::move(name),
             .baseColorFactor = float4(color, 1),
             .metallicFactor = metallic,
             .roughnessFactor = roughness };
}

/// Factors of 1: the images contain everything.
MaterialData pictured(std::string name, TextureSetImages const& images) {
    MaterialData material{ .name = std::move(name), .metallicFactor = images.surface == assets::kNone ? 0.0f : 1.0f };
    material.baseColor = textured(images.color);
    material.metallicRoughness = textured(images.surface);
    material.normal = textured(images.normal);
    material.emissive = textured(images.emission);
    return material;
}

MaterialData glass(std::string name, float3 color, float alpha) {
    MaterialData material = plain(std::move(name), color, 0, 0.05f);
    material.baseColorFactor.w = alpha;
    material.alphaMode = AlphaMode::Blend;
    return material;
}

MaterialData glowing(std::string name, float3 color, float strength) {
    MaterialData material = plain(std::move(name), float3(0), 0, 1);
    material.emissiveFactor = color;
    material.emissiveStrength = strength;
    return material;
}

// The stage: a slab of 10 x 9.6 m with its top at y = 0, and stairs for the chart at the back.
constexpr uint32_t kRows = 5, kColumns = 7;
constexpr float kStairDepth = 1.14f, kStairRise = 0.8f, kFirstStairZ = 0.35f;

float3 chartPosition(uint32_t row, uint32_t column) {
    return { (static_cast<float>(column) - 3) * 1.36f, kStairRise * (static_cast<float>(row) + 0.5f),
             kFirstStairZ - kStairDepth * static_cast<float>(row) };
}

void addStage(SceneBuilder& scene, Images const& images) {
    const uint32_t floor = scene.add(pictured("terrazzo", images[Terrazzo]));
    scene.place("slab", roundedBox({ 5, 0.25f, 4.9f }, 0.08f, 3, 0.4f), floor, { 0, -0.25f, 0 });
    const uint32_t stairs = scene.add(plain("stairs", { 0.42f, 0.41f, 0.40f }, 0, 0.6f));
    for (uint32_t row = 0; row < kRows; ++row) {
        const float3 top = chartPosition(row, 3);
        const float halfHeight = 0.5f * top.y + 0.05f; // the foot sinks into the slab
        scene.place("stair", roundedBox({ 4.85f, halfHeight, kStairDepth * 0.5f - 0.01f }, 0.05f, 3), stairs,
                    { 0, top.y - halfHeight, top.z });
    }
}

void addChart(SceneBuilder& scene) {
    struct Row {
        const char* name;
        float3 color;
        float metallic;
    };
    // Reflectances at normal incidence: metals from Lagarde's charts of measured spectra, linear Rec. 709.
    constexpr Row kChart[kRows] = { { "lacquer", { 0.42f, 0.02f, 0.025f }, 0 },
                                    { "iron", { 0.56f, 0.57f, 0.58f }, 1 },
                                    { "copper", { 0.95f, 0.64f, 0.54f }, 1 },
                                    { "gold", { 1.00f, 0.71f, 0.29f }, 1 },
                                    { "silver", { 0.97f, 0.96f, 0.91f }, 1 } };
    constexpr float kRadius = 0.5f;
    const Shape ball = sphere(kRadius, 40);
    for (uint32_t row = 0; row < kRows; ++row) {
        for (uint32_t column = 0; column < kColumns; ++column) {
            const float roughness = static_cast<float>(column) / (kColumns - 1);
            const std::string name = fmt::format("{}, roughness {:.2f}", kChart[row].name, roughness);
            const uint32_t material = scene.add(plain(name, kChart[row].color, kChart[row].metallic, roughness));
            scene.place(name, ball, material, chartPosition(row, column) + float3(0, kRadius, 0));
        }
    }
}

/// A turned column with a knot of all hues on top.
void addCenterpiece(SceneBuilder& scene, float3 foot) {
    constexpr float2 kColumn[] = { { 0, 0 },         { 0.55f, 0.0f },  { 0.56f, 0.08f },
                                   { 0.30f, 0.16f }, { 0.22f, 0.45f }, { 0.28f, 0.66f },
                                   { 0.46f, 0.74f }, { 0.44f, 0.80f }, { 0, 0.81f } };
    const uint32_t marble = scene.add(plain("marble", { 0.78f, 0.76f, 0.72f }, 0, 0.25f));
    scene.place("column", lathe(smoothProfile(kColumn, 8), 48), marble, foot);
    const uint32_t hues = scene.add(plain("hues", float3(1), 0, 0.12f));
    scene.place("knot", torusKnot(2, 3, 0.85f, 0.17f, 360, 20), hues, foot + float3(0, 1.72f, 0), 0.5f);
}

void addLamp(SceneBuilder& scene, Images const& images, float3 center) {
    MaterialData lattice = pictured("lattice", images[Lattice]);
    lattice.roughnessFactor = 0.35f;
    lattice.alphaMode = AlphaMode::Mask;
    lattice.doubleSided = true;
    scene.place("lamp shade", sphere(0.85f, 64, { 3, 1.5f }), scene.add(lattice), center);
    scene.place("lamp", sphere(0.4f, 40), scene.add(glowing("lamp", { 1.0f, 0.62f, 0.28f }, 1.5f)), center);
}

void addPanes(SceneBuilder& scene, Images const& images) {
    MaterialData stained = pictured("stained glass", images[StainedGlass]);
    stained.alphaMode = AlphaMode::Blend;
    const Shape window = roundedBox({ 0.75f, 0.95f, 0.03f }, 0.03f, 2, 0.6f);
    scene.place("window", window, scene.add(stained), { -1.75f, 0.95f, 2.2f }, 0.2f);

    const Shape pane = roundedBox({ 0.5f, 0.8f, 0.025f }, 0.025f, 2);
    constexpr float3 kColors[] = { { 0.02f, 0.42f, 0.55f }, { 0.55f, 0.03f, 0.32f }, { 0.62f, 0.45f, 0.02f } };
    constexpr const char* kNames[] = { "cyan glass", "magenta glass", "yellow glass" };
    for (int i = 0; i < 3; ++i) {
        const float step = static_cast<float>(i);
        scene.place(kNames[i], pane, scene.add(glass(kNames[i], kColors[i], 0.5f)),
                    { 3.1f + 0.5f * step, 0.8f, 3.4f + 0.35f * step }, 0.3f);
    }
}

void addTexturedExhibits(SceneBuilder& scene, Images const& images) {
    scene.place("brick ball", sphere(0.85f, 64, { 3, 1.5f }), scene.add(pictured("brick", images[Brick])),
                { -3.75f, 0.85f, 2.1f }, 0.8f);

    MaterialData dimpled = plain("dimpled gold", { 1.00f, 0.71f, 0.29f }, 1, 0.16f);
    dimpled.normal = textured(images[Dimple].normal);
    scene.place("dimpled ball", sphere(0.8f, 64, { 3, 1.5f }), scene.add(dimpled), { 1.95f, 0.8f, 2.1f });

    scene.place("wooden cube", roundedBox({ 0.58f, 0.58f, 0.58f }, 0.09f, 4, 0.8f),
                scene.add(pictured("wood", images[Wood])), { -3.7f, 0.58f, 3.85f }, 0.5f);
    scene.place("checkered ball", sphere(0.62f, 56, { 2, 1 }), scene.add(pictured("checker", images[Checker])),
                { -1.75f, 0.62f, 3.8f });

    MaterialData lava = pictured("lava", images[Lava]);
    lava.emissiveFactor = float3(1);
    lava.emissiveStrength = 2.0f;
    scene.place("lava ball", sphere(0.62f, 56, { 2, 1 }), scene.add(lava), { 0.15f, 0.62f, 3.85f });

    MaterialData steel = plain("brushed steel", { 0.62f, 0.60f, 0.57f }, 1, 1);
    steel.metallicRoughness = textured(images[Brushed].surface);
    scene.place("steel ring", torus(0.52f, 0.2f, 72, 28), scene.add(steel), { 1.85f, 0.2f, 3.85f });
}

/// Four beads, each three times as bright as the previous one: shows the tone mapper's shoulder. glTF's emission does
/// not depend on the exposure; 1 is as bright as a correctly exposed white wall.
void addBeads(SceneBuilder& scene) {
    const Shape bead = sphere(0.13f, 28);
    float strength = 0.2f;
    for (int i = 0; i < 4; ++i, strength *= 3) {
        const std::string name = fmt::format("bead of strength {:.1f}", strength);
        const uint32_t material = scene.add(glowing(name, { 0.25f, 0.65f, 1.0f }, strength));
        scene.place(name, bead, material, { 0.9f + 0.42f * static_cast<float>(i), 0.13f, 4.68f });
    }
}

assets::AnalyticSkyOptions skyOptions(bool sunDisc) {
    return {
        .sunDirection = kTowardsSun, .turbidity = 3.0f, .groundAlbedo = { 0.30f, 0.29f, 0.27f }, .sunDisc = sunDisc
    };
}

/// The model contains its sun as a light, so the sky has no disc. Below the horizon the sky is mirrored as in still
/// water, a backdrop without a horizon line; further down it is sunlit ground.
Result<assets::HdrImage> makeSky(jobs::JobSystem& jobs) {
    Result<assets::HdrImage> sky = assets::makeAnalyticSky(skyOptions(false), jobs);
    if (!sky) return sky;
    const Result<assets::HdrImage> sunlit = assets::makeAnalyticSky(skyOptions(true), jobs);
    if (!sunlit) return sunlit;
    const uint32_t horizon = sky->height / 2;
    for (uint32_t y = horizon; y < sky->height; ++y) {
        const float below = kPi * (static_cast<float>(y - horizon) + 0.5f) / static_cast<float>(sky->height);
        const float ground = glm::smoothstep(0.5f, 1.3f, below);
        for (uint32_t x = 0; x < sky->width; ++x) {
            sky->at(x, y) = glm::mix(sky->at(x, sky->height - 1 - y), sunlit->at(x, y), ground);
        }
    }
    for (float3& pixel : sky->pixels) pixel /= kSkyUnit;
    return sky;
}

} // namespace

Result<assets::GlbScene> makeScene(jobs::JobSystem& jobs) {
    SceneBuilder scene("showcase");
    const Result<Images> images = addAllPictures(scene, jobs);
    if (!images) return images.error();
    addStage(scene, *images);
    addChart(scene);
    addCenterpiece(scene, { 0, 0, 2.1f });
    addLamp(scene, *images, { 3.85f, 0.85f, 2.0f });
    addTexturedExhibits(scene, *images);
    addBeads(scene);
    addPanes(scene, *images);
    const float3 sun = assets::analyticSunIlluminance(skyOptions(true)) * 1000.0f;
    const float lux = std::max({ sun.x, sun.y, sun.z });
    scene.addSun(kTowardsSun, sun / lux, lux);
    return scene.take();
}

Result<Files> writeFiles(std::filesystem::path const& folder, jobs::JobSystem& jobs) {
    const Files files{ .model = folder / "showcase.glb", .environment = folder / "showcase.hdr" };
    const Result<assets::GlbScene> scene = makeScene(jobs);
    if (!scene) return scene.error();
    const Result<std::vector<std::byte>> bytes = assets::writeGlb(*scene);
    if (!bytes) return bytes.error();
    if (Result<void> written = assets::replaceFile(files.model, *bytes); !written) return written.error();

    const Result<assets::HdrImage> sky = makeSky(jobs);
    if (!sky) return sky.error();
    if (Result<void> written = assets::writeHdr(files.environment, *sky); !written) return written.error();
    return files;
}

Result<std::filesystem::path> writeSky(std::filesystem::path const& folder, jobs::JobSystem& jobs) {
    const std::filesystem::path file = folder / fmt::format("showcase-sky-{}.hdr", kSkyVersion);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
    const Result<assets::HdrImage> sky = makeSky(jobs);
    if (!sky) return sky.error();
    if (Result<void> written = assets::writeHdr(file, *sky); !written) return written.error();
    return file;
}

} // namespace filament_core::showcase
