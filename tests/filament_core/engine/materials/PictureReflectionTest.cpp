// SPDX-License-Identifier: Apache-2.0
// Screen-space reflections on both APIs: a mirror on the floor shows the mirror image of the wall behind it, from the
// second frame on.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <functional>
#include <vector>

namespace filament_core {
namespace {

using test::halfPixel;

constexpr double kFloorY = -0.5, kWallZ = -1.5, kWallSide = 4;

std::string floorText(std::string_view properties, std::string_view code = "") {
    return test::text(properties, "material.baseColor.rgb = vec3(1.0); material.metallic = 1.0; "
                                  "material.roughness = 0.0; " +
                                          std::string(code));
}

/// The wall's colour is linear in x and y.
float3 colorOfWall(double3 at) { return float3(0.5 + 0.1 * at.x, 0.5 + 0.2 * at.y, 0.25); }

/// A floor, and a wall behind it, without any other light.
class MirrorRoom {
public:
    explicit MirrorRoom(Backend backend, std::string const& floor = floorText("reflections : screenspace"))
            : mEngine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              mSquare(mEngine), mScene(mEngine), mRenderer(mEngine) {
        const double4x4 flat = glm::rotate(double4x4(1.0), glm::radians(-90.0), double3(1, 0, 0));
        mFloor = load(floor);
        mSquare.add(
                mScene, instance(mFloor),
                glm::translate(double4x4(1.0), double3(0, kFloorY, 0)) * flat *
                        double4x4(double4(2, 0, 0, 0), double4(0, 2, 0, 0), double4(0, 0, 2, 0), double4(0, 0, 0, 1)));
        mWall = load(test::text("shadingModel : unlit, flipUV : false, requires : [ uv0 ]",
                                "vec2 at = (getUV0() * vec2(2.0, -2.0) + vec2(-1.0, 1.0)) * 4.0; "
                                "material.baseColor = vec4(0.5 + 0.1 * at.x, 0.5 + 0.2 * at.y, 0.25, 1.0);"));
        wall = mSquare.add(mScene, instance(mWall), double3(0, 0, kWallZ), kWallSide);
        view.camera = Camera::lookAt({ 0, 0.2, 1.5 }, { 0, -0.2, 0 }, { .verticalFovDegrees = 50 });
        view.size = { 96, 64 };
        view.quality.shadows = ShadowFilter::Off;
        view.effects.screenSpaceReflections = { .enabled = true, .distanceMeters = 20, .thicknessMeters = 0.5f };
    }
    ~MirrorRoom() { test::expectNoErrors(mEngine); }

    Image draw() { return test::renderLinear(mEngine, mRenderer, mScene, view); }
    FrameStatistics statistics() const { return mRenderer.statistics(); }
    Engine& engine() { return mEngine; }
    Scene& scene() { return mScene; }

    void placeWall(double3 offset) {
        double4x4 world(kWallSide);
        world[3] = double4(offset + double3(0, 0, kWallZ), 1);
        mScene.setTransform(wall, world);
    }

    View view;
    Renderable wall;

private:
    Owned<Material> load(std::string const& text) { return test::loadMaterial(mEngine, text, {}, test::kNoShadows); }
    MaterialInstance instance(Owned<Material> const& material) {
        mInstances.push_back(mEngine.own(mEngine.createInstance(material)));
        return mInstances.back();
    }

    Engine mEngine;
    test::SquareMesh mSquare;
    Scene mScene;
    Renderer mRenderer;
    Owned<Material> mFloor, mWall;
    std::vector<Owned<MaterialInstance>> mInstances;
};

/// The images of both APIs after `frames`, which have the same bits.
Image mirrored(
        int frames, std::function<void(MirrorRoom&, int)> const& change = [](MirrorRoom&, int) {},
        std::string const& floor = floorText("reflections : screenspace")) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        MirrorRoom room(backend, floor);
        Image last;
        for (int i = 0; i < frames; ++i) {
            change(room, i);
            last = room.draw();
        }
        images.push_back(std::move(last));
    }
    EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u);
    return std::move(images[0]);
}

struct ViewRay {
    double3 from, direction;
};

ViewRay rayThrough(Camera const& camera, uint2 size, uint32_t x, uint32_t y) {
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const double4x4 clip(camera.clipFromView(aspect));
    const double2 at = (double2(x, y) + 0.5) / double2(size) * 2.0 - 1.0;
    const double3 inView(at.x / clip[0].x, at.y / clip[1].y, -1);
    return { camera.position(), double3(camera.worldFromView * double4(inView, 0)) };
}

/// Where the mirrored ray of a pixel of the floor meets the wall; nothing for other pixels.
std::optional<double3> mirroredPoint(Camera const& camera, uint2 size, uint32_t x, uint32_t y) {
    const ViewRay ray = rayThrough(camera, size, x, y);
    if (ray.direction.y >= 0) return std::nullopt;
    const double3 floor = ray.from + ray.direction * ((kFloorY - ray.from.y) / ray.direction.y);
    if (floor.z <= kWallZ || std::abs(floor.x) > 2 || std::abs(floor.z) > 2) return std::nullopt;
    const double3 up(ray.direction.x, -ray.direction.y, ray.direction.z);
    return floor + up * ((kWallZ - floor.z) / up.z);
}

/// Whether a camera shows a point well inside of its image.
bool isShown(Camera const& camera, uint2 size, double3 point, double border) {
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const double4 clip =
            double4x4(camera.clipFromView(aspect)) * glm::inverse(camera.worldFromView) * double4(point, 1);
    const double2 uv = double2(clip) / clip.w * 0.5 + 0.5;
    return clip.w > 0 && std::min(std::min(uv.x, uv.y), std::min(1 - uv.x, 1 - uv.y)) > border;
}

/// Pixels of the floor that a frame after `before` must show as the image of the wall, which came by `step` and now
/// lies two such steps off its place; returns how many there were.
uint32_t expectImageOfWall(Image const& picture, Camera const& camera, Camera const& before, float tolerance,
                           double3 step = double3(0)) {
    const uint2 size(picture.width, picture.height);
    uint32_t count = 0;
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            const auto point = mirroredPoint(camera, size, x, y);
            if (!point || !isShown(before, size, *point - step, 0.1) || !isShown(camera, size, *point, 0.1)) continue;
            const float3 seen(halfPixel(picture, x, y)), wanted = colorOfWall(*point - step * 2.0);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(seen[c], wanted[c], tolerance) << x << ", " << y << " channel " << c;
            ++count;
        }
    }
    return count;
}

TEST(PictureReflection, AMirrorShowsTheWallWhereItsImageIs) {
    const Image picture = mirrored(2);
    const Camera camera = Camera::lookAt({ 0, 0.2, 1.5 }, { 0, -0.2, 0 }, { .verticalFovDegrees = 50 });
    EXPECT_GT(expectImageOfWall(picture, camera, camera, 0.02f), 500u);
}

TEST(PictureReflection, TheFirstFrameKnowsNoPicture) {
    const Image picture = mirrored(1);
    const Camera camera = Camera::lookAt({ 0, 0.2, 1.5 }, { 0, -0.2, 0 }, { .verticalFovDegrees = 50 });
    for (uint32_t y = 0; y < picture.height; ++y) {
        if (!mirroredPoint(camera, { picture.width, picture.height }, 48, y)) continue;
        EXPECT_EQ(float3(halfPixel(picture, 48, y)), float3(0)) << y;
    }
}

TEST(PictureReflection, AMovingCameraFindsTheWallInTheHistory) {
    const auto cameraOf = [](int frame) {
        return Camera::lookAt({ 0.1 * frame, 0.2 + 0.03 * frame, 1.5 - 0.05 * frame }, { 0.05 * frame, -0.2, 0 },
                              { .verticalFovDegrees = 50 });
    };
    const Image picture = mirrored(3, [&](MirrorRoom& room, int frame) { room.view.camera = cameraOf(frame); });
    EXPECT_GT(expectImageOfWall(picture, cameraOf(2), cameraOf(1), 0.03f), 400u);
}

/// The wall's colours go with it: without motion its image would be that of the place where it was.
TEST(PictureReflection, AMovingObjectIsFoundInTheHistory) {
    constexpr double3 kMovedBy(0.3, -0.1, 0);
    const Image picture =
            mirrored(3, [&](MirrorRoom& room, int frame) { room.placeWall(kMovedBy * static_cast<double>(frame)); });
    const Camera camera = Camera::lookAt({ 0, 0.2, 1.5 }, { 0, -0.2, 0 }, { .verticalFovDegrees = 50 });
    EXPECT_GT(expectImageOfWall(picture, camera, camera, 0.02f, kMovedBy), 400u);
}

TEST(PictureReflection, ARoughMirrorBlursTheImageAndKeepsItsMean) {
    const auto row = [](std::string_view roughness) {
        const Image picture = mirrored(
                2, [](MirrorRoom&, int) {}, floorText("reflections : screenspace", roughness));
        float3 sum(0);
        for (uint32_t x = 40; x < 56; ++x) sum += float3(halfPixel(picture, x, 50));
        return sum / 16.0f;
    };
    const float3 smooth = row("material.roughness = 0.0;"), rough = row("material.roughness = 0.25;");
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rough[c], smooth[c], 0.12f) << "channel " << c;
}

TEST(PictureReflection, NothingChangesWithoutReflectiveMaterials) {
    for (const Backend backend : test::kBothApis) {
        MirrorRoom room(backend, floorText("shadingModel : lit"));
        room.view.effects.screenSpaceReflections.enabled = false;
        const Image off = room.draw();
        const uint32_t passes = room.statistics().passesRun, draws = room.statistics().draws;
        room.view.effects.screenSpaceReflections.enabled = true;
        const Image on = room.draw();
        EXPECT_EQ(test::differingPixels(off, on), 0u);
        EXPECT_EQ(room.statistics().passesRun, passes);
        EXPECT_EQ(room.statistics().draws, draws);
    }
}

/// Pictures of both APIs for each of several settings, one engine each; they have the same bits.
void expectSameBits(size_t settings, std::function<void(MirrorRoom&, size_t)> const& set,
                    std::function<void(Image const&)> const& check) {
    std::vector<Image> first;
    for (const Backend backend : test::kBothApis) {
        MirrorRoom room(backend);
        for (size_t i = 0; i < settings; ++i) {
            set(room, i);
            Image image;
            for (int frame = 0; frame < 3; ++frame) {
                room.view.camera =
                        Camera::lookAt({ 0.2 * frame, 0.2, 1.5 }, { 0, -0.2, 0 }, { .verticalFovDegrees = 50 });
                image = room.draw();
            }
            check(image);
            if (backend == test::kBothApis[0])
                first.push_back(std::move(image));
            else
                EXPECT_EQ(test::differingPixels(first[i], image), 0u) << "setting " << i;
        }
    }
}

TEST(PictureReflection, SizesAndSamplesHaveTheSameBitsOnBothApis) {
    constexpr std::array kSizes{ uint2(33, 17), uint2(7, 65), uint2(1, 1), uint2(130, 64) };
    expectSameBits(
            kSizes.size() * 2,
            [&](MirrorRoom& room, size_t i) {
                room.view.size = kSizes[i / 2];
                room.view.samples = i % 2 ? 4 : 1;
            },
            [](Image const& image) { test::extremesOf(image); }); // all finite
}

TEST(PictureReflection, OptionsAtTheirEndsGiveNumbers) {
    expectSameBits(
            4,
            [](MirrorRoom& room, size_t i) {
                room.view.effects.screenSpaceReflections = { .enabled = true,
                                                             .steps = i % 2 ? uint8_t{ 8 } : uint8_t{ 255 },
                                                             .distanceMeters = i % 2 ? 1e-3f : 1e5f,
                                                             .thicknessMeters = i / 2 ? 1e-4f : 1e4f };
            },
            [](Image const& image) {
                const test::Extremes found = test::extremesOf(image);
                EXPECT_GE(found.least, 0);
                EXPECT_LE(found.most, 1.4f) << "no brighter than the wall";
            });
}

} // namespace
} // namespace filament_core
