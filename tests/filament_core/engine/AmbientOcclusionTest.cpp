// SPDX-License-Identifier: Apache-2.0
// Effects::ambientOcclusion on both APIs: visibilities are compared with rays that are traced through the same squares
// on the CPU; what it must not change has the bits that it had.
#include "tests/filament_core/engine/ShadowStage.h"
#include "tests/filament_core/engine/WhiteEnvironment.h"

#include <array>

namespace filament_core {
namespace {

using test::kBothApis;
using Method = AmbientOcclusionMethod;
using Resolution = AmbientOcclusionResolution;

constexpr Method kMethods[] = { Method::Sao, Method::Gtao };
constexpr Resolution kResolutions[] = { Resolution::Full, Resolution::Half, Resolution::Checkerboard };

// ---- squares, on the device and on the CPU

/// A square of half side 1, placed.
struct Placed {
    double4x4 world;
    double4x4 local = glm::inverse(world);
};

Placed placed(double3 at, double3 halfSize = double3(1), double turn = 0, double3 axis = { 0, 1, 0 }) {
    return { glm::translate(double4x4(1), at) * glm::rotate(double4x4(1), turn, axis) *
             glm::scale(double4x4(1), halfSize) };
}

struct OcclusionRay {
    double3 from, along;
};

/// The distance along a ray, or infinity.
double distanceTo(Placed const& square, OcclusionRay const& ray) {
    const double3 from(square.local * double4(ray.from, 1)), along(square.local * double4(ray.along, 0));
    const double t = -from.z / along.z;
    const double3 at = from + along * t;
    const bool isHit = t > 1e-9 && std::abs(at.x) <= 1 && std::abs(at.y) <= 1;
    return isHit ? t : std::numeric_limits<double>::infinity();
}

struct Found {
    double distance = std::numeric_limits<double>::infinity();
    double3 normal{ 0 };
};

Found nearestOf(std::span<const Placed> squares, OcclusionRay const& ray) {
    Found found;
    for (Placed const& square : squares) {
        const double distance = distanceTo(square, ray);
        if (distance >= found.distance) continue;
        const double3 normal = glm::normalize(double3(square.world[2]));
        found = { distance, glm::dot(normal, ray.along) < 0 ? normal : -normal };
    }
    return found;
}

/// A square seen from a point whose hemisphere is spanned by three axes: all in the space of the square.
struct SquareFromPoint {
    double3 from, x, y, up;

    SquareFromPoint(Placed const& square, double3 point, double3 axisX, double3 axisY, double3 normal)
            : from(square.local * double4(point, 1)), x(square.local * double4(axisX, 0)),
              y(square.local * double4(axisY, 0)), up(square.local * double4(normal, 0)) {}

    /// Whether the square lies within `radius` in direction cx * x + cy * y + cz * up. Numbers instead of vectors,
    /// because this runs fifty million times, and vectors take several times as long in tests without optimisation.
    bool isWithin(double radius, double cx, double cy, double cz) const {
        const double t = -from.z / (x.z * cx + y.z * cy + up.z * cz);
        return t > 1e-9 && t <= radius && std::abs(from.x + (x.x * cx + y.x * cy + up.x * cz) * t) <= 1 &&
               std::abs(from.y + (x.y * cx + y.y * cy + up.y * cz) * t) <= 1;
    }
};

/// The cosine-weighted part of the hemisphere in which nothing lies within the radius, by 24 x 48 rays.
double openAt(std::span<const Placed> squares, double3 point, double3 normal, double radius) {
    const double3 x =
            glm::normalize(glm::cross(std::abs(normal.x) < 0.5 ? double3(1, 0, 0) : double3(0, 1, 0), normal));
    const double3 y = glm::cross(normal, x);
    std::vector<SquareFromPoint> seen;
    for (Placed const& square : squares) seen.emplace_back(square, point + normal * 1e-6, x, y, normal);
    int open = 0;
    for (int j = 0; j < 48; ++j) {
        const double angle = 2 * glm::pi<double>() * (j + 0.5) / 48, cosine = std::cos(angle), sine = std::sin(angle);
        for (int i = 0; i < 24; ++i) {
            const double r = std::sqrt((i + 0.5) / 24), height = std::sqrt(1 - r * r);
            bool isOpen = true;
            for (SquareFromPoint const& square : seen)
                isOpen = isOpen && !square.isWithin(radius, r * cosine, r * sine, height);
            open += isOpen;
        }
    }
    return open / (24.0 * 48.0);
}

OcclusionRay rayOfPixel(View const& view, uint32_t x, uint32_t y) {
    const double4x4 clip(view.camera.clipFromView(static_cast<float>(view.size.x) / static_cast<float>(view.size.y)));
    const double2 ndc((x + 0.5) / view.size.x * 2 - 1, (y + 0.5) / view.size.y * 2 - 1);
    const double3 along = double3x3(view.camera.worldFromView) * double3(ndc.x / clip[0][0], ndc.y / clip[1][1], -1);
    return { view.camera.position(), glm::normalize(along) };
}

struct OcclusionStage : test::ShadowStage {
    WhiteEnvironment environment{ engine };
    Renderer renderer{ engine };

    explicit OcclusionStage(Backend backend) : ShadowStage(backend) {}

    Scene sceneOf(std::span<const Placed> squares, View const& view) {
        Scene scene(engine);
        for (Placed const& one : squares) square.add(scene, white, one.world);
        environment.light(scene, view.camera);
        return scene;
    }
    Image drawVisibility(Scene const& scene, View view) {
        view.debugView = DebugView::Occlusion;
        Result<Image> image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image.ok());
        return image ? std::move(*image) : Image{};
    }
};

View occludedView(double3 eye, double3 at, Method method, double radius, uint2 size = { 96, 64 }) {
    View view{ .camera = Camera::lookAt(eye, at, { .verticalFovDegrees = 50, .nearMeters = 0.05f }, {}, { 0, 0, 1 }),
               .size = size };
    view.quality.shadows = ShadowFilter::Off;
    view.effects.ambientOcclusion.enabled = true;
    view.effects.ambientOcclusion.method = method;
    view.effects.ambientOcclusion.resolution = Resolution::Full;
    view.effects.ambientOcclusion.radiusMeters = static_cast<float>(radius);
    return view;
}

/// By pixel, from the first row on; nothing where no square is.
using Visibilities = std::vector<std::optional<double>>;

Visibilities tracedVisibilities(View const& view, std::span<const Placed> squares) {
    Visibilities traced;
    for (uint32_t y = 0; y < view.size.y; ++y) {
        for (uint32_t x = 0; x < view.size.x; ++x) {
            const OcclusionRay ray = rayOfPixel(view, x, y);
            const Found found = nearestOf(squares, ray);
            const double3 point = ray.from + ray.along * found.distance;
            const bool isHit = std::isfinite(found.distance);
            const auto radius = static_cast<double>(view.effects.ambientOcclusion.radiusMeters);
            traced.push_back(isHit ? std::optional(openAt(squares, point, found.normal, radius)) : std::nullopt);
        }
    }
    return traced;
}

/// Root mean square, over all pixels that show a square.
double errorOf(Image const& image, Visibilities const& traced) {
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i < traced.size(); ++i) {
        if (!traced[i]) continue;
        const auto x = static_cast<uint32_t>(i % image.width), y = static_cast<uint32_t>(i / image.width);
        const double off = static_cast<double>(test::bytePixel(image, x, y).x) - *traced[i];
        sum += off * off, ++count;
    }
    return std::sqrt(sum / count);
}

// ---- closed forms

TEST(AmbientOcclusion, APlaneIsOpenFromEveryDirection) {
    const std::array squares{ placed({ 0, 0, 0 }, double3(50)) };
    for (const Backend backend : kBothApis) {
        OcclusionStage stage(backend);
        for (const Method method : kMethods) {
            for (const double3 eye : { double3(0.1, 0, 2), double3(2, 1, 0.6), double3(5, 0, 0.3) }) {
                const View view = occludedView(eye, { 0, 0, 0 }, method, 0.5);
                const Image image = stage.drawVisibility(stage.sceneOf(squares, view), view);
                int closed = 0; // where a corner of the plane has no two pixels to either side
                for (uint32_t y = 0; y < view.size.y; ++y)
                    for (uint32_t x = 0; x < view.size.x; ++x) closed += test::bytePixel(image, x, y).x < 254.0f / 255;
                EXPECT_LE(closed, 20) << toString(backend) << ' ' << toString(method) << ' ' << eye.z;
            }
        }
    }
}

struct ClosedForm {
    const char* name;
    std::vector<Placed> squares;
    double3 eye;
    double mostOfSao, mostOfGtao; ///< root mean square
};

std::vector<ClosedForm> closedForms() {
    const double quarter = glm::half_pi<double>();
    const Placed floor = placed({ 0, 0, 0 }, double3(3));
    std::vector<ClosedForm> forms;
    forms.push_back(
            { "an edge", { floor, placed({ -0.3, 0, 1 }, { 1, 3, 1 }, quarter) }, { 1.6, -0.8, 1.1 }, 0.08, 0.04 });
    forms.push_back({ "a corner",
                      { floor, placed({ -0.3, 0, 1 }, { 1, 3, 1 }, quarter),
                        placed({ 0, 0.4, 1 }, { 3, 1, 1 }, quarter, { 1, 0, 0 }) },
                      { 1.4, -1.2, 1.2 },
                      0.08,
                      0.05 });
    forms.push_back({ "a gap", { floor, placed({ 0, 0, 0.1 }, { 0.4, 0.3, 1 }) }, { 1.5, -1.0, 0.5 }, 0.125, 0.06 });
    return forms;
}

TEST(AmbientOcclusion, IsThatOfTracedRaysOfTheSameRadius) {
    OcclusionStage stage(Backend::Vulkan);
    for (ClosedForm const& form : closedForms()) {
        const Visibilities traced =
                tracedVisibilities(occludedView(form.eye, { 0, 0, 0.15 }, Method::Gtao, 0.4), form.squares);
        for (const Method method : kMethods) {
            View view = occludedView(form.eye, { 0, 0, 0.15 }, method, 0.4);
            view.effects.ambientOcclusion.samples = 16;
            view.effects.ambientOcclusion.slices = 3;
            const Scene scene = stage.sceneOf(form.squares, view);
            const double error = errorOf(stage.drawVisibility(scene, view), traced);
            const double most = method == Method::Sao ? form.mostOfSao : form.mostOfGtao;
            EXPECT_LT(error, most) << form.name << ' ' << toString(method);
            RecordProperty(std::string(form.name) + toString(method), std::to_string(error));
            view.effects.ambientOcclusion.radiusMeters = 0.8f; // twice the requested radius: the bound detects it
            const Image wrong = stage.drawVisibility(scene, view);
            EXPECT_GT(errorOf(wrong, traced), most) << form.name << ' ' << toString(method);
        }
    }
}

// ---- any input

TEST(AmbientOcclusion, IsFiniteForAnyRadiusAndPlace) {
    const std::array squares{ placed({ 0, 0, 0 }), placed({ -0.3, 0, 1 }, double3(1), glm::half_pi<double>()) };
    OcclusionStage stage(Backend::Vulkan);
    for (const Method method : kMethods) {
        for (const double radius : { 1e-3, 0.3, 1e3 }) {
            View view = occludedView({ 1.6, -0.8, 1.1 }, { 0, 0, 0 }, method, radius, { 33, 21 });
            view.effects.ambientOcclusion.bentNormals = true;
            const Scene scene = stage.sceneOf(squares, view);
            const Image image = test::renderLinear(stage.engine, scene, view);
            const test::Extremes found = test::extremesOf(image);
            EXPECT_GE(found.least, 0.0f);
            EXPECT_LE(found.most, 1.001f) << "a furnace gains nothing";
            const Image visibility = stage.drawVisibility(scene, view);
            EXPECT_EQ(test::bytePixel(visibility, 0, 0).x, 1.0f) << "the sky is open";
        }
        // From 10^7 m away, through a lens of as much: as from nearby, except for the perspective.
        View view = occludedView({ 1.6e7, -0.8e7, 1.1e7 }, { 0, 0, 0 }, method, 0.4, { 33, 21 });
        view.camera.lens.verticalFovDegrees = 6e-6f;
        const Image far = stage.drawVisibility(stage.sceneOf(squares, view), view);
        for (uint32_t y = 0; y < far.height; ++y)
            for (uint32_t x = 0; x < far.width; ++x) EXPECT_GE(test::bytePixel(far, x, y).x, 0.0f);
    }
}

// ---- what it darkens

TEST(AmbientOcclusion, LeavesEverythingElseAlone) {
    const std::array squares{ placed({ 0, 0, 0 }), placed({ -0.3, 0, 1 }, double3(1), glm::half_pi<double>()) };
    OcclusionStage stage(Backend::Vulkan);
    View off = occludedView({ 1.6, -0.8, 1.1 }, { 0, 0, 0 }, Method::Gtao, 0.4);
    off.effects.ambientOcclusion.enabled = false;
    View on = off;
    on.effects.ambientOcclusion.enabled = true;
    Scene scene = stage.sceneOf(squares, off);
    scene.add(SunLight{ .directionWorld = { -0.4f, 0.3f, -1 }, .illuminance = Lux{ 20'000 } });
    const Image plain = test::renderLinear(stage.engine, scene, off),
                dark = test::renderLinear(stage.engine, scene, on);
    EXPECT_GT(test::differingPixels(plain, dark), 500u);
    on.effects.ambientOcclusion.intensity = 0;
    EXPECT_EQ(test::differingPixels(plain, test::renderLinear(stage.engine, scene, on)), 0u) << "an intensity of 0";
    on.effects.ambientOcclusion.intensity = 1;
    scene.setIndirectLight({}, {});
    EXPECT_EQ(test::differingPixels(test::renderLinear(stage.engine, scene, off),
                                    test::renderLinear(stage.engine, scene, on)),
              0u)
            << "direct light";
}

TEST(AmbientOcclusion, DarkensWhiteSurfacesByTheVisibilityThatItShows) {
    const std::array squares{ placed({ 0, 0, 0 }), placed({ -0.3, 0, 1 }, double3(1), glm::half_pi<double>()) };
    OcclusionStage stage(Backend::Vulkan);
    const Owned<Material> chalk =
            test::loadMaterial(stage.engine, R"(material { name : plaster, shadingModel : lit, doubleSided : true,
                             multiBounceAmbientOcclusion : false, specularAmbientOcclusion : none }
            fragment { void material(inout MaterialInputs material) {
                prepareMaterial(material);
                material.baseColor.rgb = vec3(0.5);
                material.roughness = 1.0;
                material.reflectance = 0.0;
            } })");
    const Owned<MaterialInstance> plaster = stage.engine.own(stage.engine.createInstance(chalk));
    View view = occludedView({ 1.6, -0.8, 1.1 }, { 0, 0, 0 }, Method::Gtao, 0.4);
    Scene scene(stage.engine);
    for (Placed const& one : squares) stage.square.add(scene, plaster, one.world);
    stage.environment.light(scene, view.camera);
    const Image dark = test::renderLinear(stage.engine, scene, view);
    const Image visibility = stage.drawVisibility(scene, view);
    for (uint32_t y = 0; y < view.size.y; ++y) {
        for (uint32_t x = 0; x < view.size.x; ++x) {
            if (!std::isfinite(nearestOf(squares, rayOfPixel(view, x, y)).distance)) continue;
            EXPECT_NEAR(test::halfPixel(dark, x, y).x, 0.5f * test::bytePixel(visibility, x, y).x, 2e-3f);
        }
    }
}

// ---- the same bits

TEST(AmbientOcclusion, HasTheSameBitsOnBothApis) {
    std::vector<Placed> squares{ placed({ 0, 0, 0 }, double3(2)) };
    prepare::Random random(7);
    for (int i = 0; i < 12; ++i) {
        const double3 at(random.within(-1, 1), random.within(-1, 1), random.within(0, 0.6));
        squares.push_back(placed(at, double3(random.within(0.1, 0.5)), random.within(0, 3),
                                 glm::normalize(double3(random.within(-1, 1), 1, random.within(-1, 1)))));
    }
    OcclusionStage vulkan(Backend::Vulkan), gles(Backend::Gles);
    for (int i = 0; i < 24; ++i) {
        View view = occludedView({ 1.6, -0.8, 1.1 }, { 0, 0, 0 }, kMethods[i % 2], random.within(0.05, 1),
                                 { 31u + static_cast<uint32_t>(i % 5), 20u + static_cast<uint32_t>(i % 3) });
        view.effects.ambientOcclusion.resolution = kResolutions[i % 3];
        view.effects.ambientOcclusion.blur = i % 4 != 3;
        view.effects.ambientOcclusion.bentNormals = i % 5 == 1 || i % 5 == 4;
        view.effects.ambientOcclusion.samples = static_cast<uint8_t>(3 + i);
        view.effects.ambientOcclusion.slices = static_cast<uint8_t>(1 + i / 2 % 3);
        view.samples = i % 7 == 3 ? 4 : 1;
        if (i % 6 == 5) view.quality.depthPrepass = DepthPrepass::Off;
        view.effects.ambientOcclusion.intensity = i % 8 == 6 ? 1.7f : 1.0f;
        const Image a = test::renderLinear(vulkan.engine, vulkan.sceneOf(squares, view), view);
        const Image b = test::renderLinear(gles.engine, gles.sceneOf(squares, view), view);
        EXPECT_EQ(test::differingPixels(a, b), 0u) << "view " << i;
    }
}

} // namespace
} // namespace filament_core
