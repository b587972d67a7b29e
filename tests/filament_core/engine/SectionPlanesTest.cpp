// SPDX-License-Identifier: Apache-2.0
// View::section on both APIs: what is left of boxes and balls, pixel by pixel beside rays that the test casts itself;
// and a cut box beside one that is as large as what is left of it, in light, shadows and effects.
#include "tests/filament_core/engine/SectionStage.h"
#include "tests/filament_core/engine/WhiteEnvironment.h"

#include <filament_core/Primitives.h>
#include <filament_core/RenderAovs.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace filament_core {
namespace {

/// Where a ray is inside of something convex, and the outward normals at both ends.
struct Stretch {
    double begin = -1e30, end = 1e30;
    double3 normal{ 0 }; ///< at `begin`

    void cut(double3 outwards, double offset, double3 origin, double3 along) { // inside: dot(outwards, p) <= offset
        const double slope = dot(outwards, along), t = (offset - dot(outwards, origin)) / slope;
        if (slope < 0 && t > begin) begin = t, normal = outwards;
        if (slope > 0) end = std::min(end, t);
        if (slope == 0 && dot(outwards, origin) > offset) end = -1e30;
    }
    bool isEmpty() const { return begin >= end; }
};

Stretch throughBox(double3 origin, double3 along) { // of 2 x 2 x 2
    Stretch stretch;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : { -1.0, 1.0 }) {
            double3 outwards(0);
            outwards[axis] = side;
            stretch.cut(outwards, 1, origin, along);
        }
    return stretch;
}

struct SolidHit {
    double3 point{ 0 }, normal{ 0 };
    bool isCap = false;
};

/// What a ray from its origin on sees of a box that the planes cut.
std::optional<SolidHit> seenOfCutBox(SectionPlanes const& section, double3 origin, double3 along, double nearest) {
    Stretch solid = throughBox(origin, along), left, corner;
    size_t planes = 0;
    for (double4 const& plane : section.planes) {
        if (!SectionPlanes::isPlane(plane)) continue;
        const double3 inwards = glm::normalize(double3(plane));
        const double offset = plane.w / glm::length(double3(plane));
        left.cut(-inwards, offset, origin, along);
        corner.cut(inwards, -offset, origin, along);
        ++planes;
    }
    double begin = std::max(solid.begin, nearest);
    const auto hit = [&](double t, double3 normal, bool isCap) {
        return SolidHit{ origin + along * t, normal, isCap };
    };
    if (planes == 0 || section.cut == SectionCut::Each) {
        const bool isCap = planes > 0 && left.begin > begin;
        if (std::max(begin, left.begin) >= std::min(solid.end, left.end)) return {};
        return hit(isCap ? left.begin : begin, isCap ? left.normal : solid.normal, isCap);
    }
    if (begin >= solid.end) return {};
    if (corner.isEmpty() || begin < corner.begin || begin >= corner.end) return hit(begin, solid.normal, false);
    if (corner.end >= solid.end) return {};
    double3 normal(0); // of the plane through which the ray leaves the corner
    for (double4 const& plane : section.planes) {
        const double3 inwards(plane);
        if (!SectionPlanes::isPlane(plane)) continue;
        if (std::abs(dot(inwards, origin + along * corner.end) + plane.w) < 1e-9) normal = -glm::normalize(inwards);
    }
    return hit(corner.end, normal, true);
}

struct SectionPlanesTest : testing::TestWithParam<Backend> {
    SectionStage stage{ GetParam() };
};
INSTANTIATE_TEST_SUITE_P(BothApis, SectionPlanesTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

/// Whether rays a fiftieth of a pixel beside this one see another face.
template <class SeenAt>
bool isBesideEdge(SeenAt const& seenAt, double2 middle) {
    const std::optional<SolidHit> seen = seenAt(middle);
    for (const double2 off : { double2(-0.02, 0), double2(0.02, 0), double2(0, -0.02), double2(0, 0.02) }) {
        const std::optional<SolidHit> beside = seenAt(middle + off);
        if (beside.has_value() != seen.has_value()) return true;
        if (seen && (beside->isCap != seen->isCap || beside->normal != seen->normal)) return true;
    }
    return false;
}

/// Compares each pixel whose neighbourhood sees one face with the ray through its middle. Returns how many show caps.
size_t expectCutBox(SectionStage& stage, Scene const& scene, double3 center, double tolerance) {
    constexpr std::array kAovs{ Aov::Position, Aov::GeometricNormal, Aov::BaseColor, Aov::Metallic };
    const auto images = renderAovs(stage.engine, scene, stage.view, kAovs);
    EXPECT_TRUE(images);
    SectionPlanes moved = stage.view.section;
    for (double4& plane : moved.planes) plane.w += dot(double3(plane), center); // relative to the box
    size_t caps = 0, different = 0;
    for (uint32_t y = 0; y < stage.view.size.y; ++y) {
        for (uint32_t x = 0; x < stage.view.size.x; ++x) {
            const auto seenAt = [&](double2 at) {
                SectionRay ray = sectionRay(stage.view, at);
                return seenOfCutBox(moved, ray.origin - center, ray.along, stage.view.camera.lens.nearMeters);
            };
            const double2 middle = double2(x, y) + 0.5;
            const std::optional<SolidHit> seen = seenAt(middle);
            if (isBesideEdge(seenAt, middle)) continue;
            const double alpha = aovNumberAt((*images)[0], { x, y }).w;
            different += alpha != (seen ? 1 : 0);
            if (!seen) continue;
            const double3 place(aovNumberAt((*images)[0], { x, y })), normal(aovNumberAt((*images)[1], { x, y }));
            const double3 expected = seen->point + center - stage.view.camera.position();
            EXPECT_LT(glm::length(place - expected), tolerance) << x << ' ' << y << (seen->isCap ? " cap" : "");
            EXPECT_LT(glm::length(normal - seen->normal), 1e-5) << x << ' ' << y << (seen->isCap ? " cap" : "");
            EXPECT_NEAR(aovNumberAt((*images)[2], { x, y }).x, seen->isCap ? 0.8 : 0.3, 1e-6) << x << ' ' << y;
            EXPECT_EQ(aovNumberAt((*images)[3], { x, y }).x, seen->isCap ? 0 : 0.75f) << "a cap is no metal";
            caps += seen->isCap;
        }
    }
    EXPECT_EQ(different, 0u);
    return caps;
}

std::vector<SectionPlanes> sectionsAt(double3 center) {
    const auto plane = [&](double3 point, double3 normal) { return sectionPlane(point + center, normal); };
    SectionPlanes none, one, tilted, slab, corner, inside, through;
    one.planes[0] = plane({ 0, 0, 0.3 }, { 0, 0, -2 });
    tilted.planes[3] = plane({ 0.1, 0.2, 0.1 }, { -0.5, -0.7, -0.6 });
    slab.planes[0] = plane({ 0, 0.6, 0 }, { 0, -1, 0 });
    slab.planes[1] = plane({ 0, -0.2, 0 }, { 0, 3, 0 });
    slab.planes[5] = plane({ 0.5, 0, 0 }, { -1, 0, 0.1 });
    corner.cut = SectionCut::Corner;
    corner.planes[0] = plane({ 0.1, 0, 0 }, { -1, 0, 0 });
    corner.planes[1] = plane({ 0, 0.2, 0 }, { 0, -1, 0 });
    corner.planes[2] = plane({ 0, 0, -0.1 }, { 0.1, 0, -1 });
    for (int axis = 0; axis < 3; ++axis) // a box, all of which is caps
        for (const double side : { -1.0, 1.0 }) {
            double3 outwards(0);
            outwards[axis] = side;
            inside.planes[static_cast<size_t>(2 * axis) + (side > 0)] = plane(outwards * 0.7, -outwards);
        }
    through.planes[0] = plane({ 0, 0, 5 }, { 0, 0, 1 });
    return { none, one, tilted, slab, corner, inside, through };
}

TEST_P(SectionPlanesTest, ShowOfABoxWhatRaysFindThatTheTestCasts) {
    Scene scene(stage.engine);
    stage.box.add(scene, stage.instance, double4x4(1));
    std::vector<size_t> caps;
    for (const bool isParallel : { false, true }) {
        if (isParallel) stage.view.camera.lens = { .orthographicHeight = 4 };
        for (SectionPlanes const& section : sectionsAt(double3(0))) {
            SCOPED_TRACE(caps.size());
            stage.view.section = section;
            caps.push_back(expectCutBox(stage, scene, double3(0), isParallel ? 1e-4 : 2e-5));
        }
    }
    for (const size_t first : { size_t{ 0 }, caps.size() / 2 }) {
        EXPECT_EQ(caps[first], 0u);
        for (size_t i = 1; i < 6; ++i) EXPECT_GT(caps[first + i], 60u) << i;
        EXPECT_EQ(caps[first + 6], 0u) << "nothing is left";
    }
}

TEST_P(SectionPlanesTest, CutABallIntoADisc) {
    constexpr double kRadius = 1, kHeight = 0.4;
    const SolidMesh ball(stage.engine, *makeUvSphere({ .radius = 1, .slices = 192, .stacks = 96 }));
    Scene scene(stage.engine);
    ball.add(scene, stage.instance, double4x4(1));
    stage.view.section.planes[0] = sectionPlane({ 0, kHeight, 0 }, { 0, -1, 0 });
    const auto images = renderAovs(stage.engine, scene, stage.view, std::array{ Aov::BaseColor, Aov::Depth });
    ASSERT_TRUE(images);
    size_t caps = 0;
    for (uint32_t y = 0; y < kSectionSize.y; ++y) {
        for (uint32_t x = 0; x < kSectionSize.x; ++x) {
            const SectionRay ray = sectionRay(stage.view, double2(x, y) + 0.5);
            const double t = (kHeight - ray.origin.y) / ray.along.y;
            const double3 point = ray.origin + ray.along * t;
            const double beyond = glm::length(point) - kRadius;
            if (std::abs(beyond) < 2e-3) continue;
            const bool isCap = aovNumberAt((*images)[0], { x, y }).x == 0.8f;
            EXPECT_EQ(isCap, t > 0 && beyond < 0) << x << ' ' << y;
            if (!isCap) continue;
            EXPECT_NEAR(aovNumberAt((*images)[1], { x, y }).x, t, 1e-5);
            ++caps;
        }
    }
    EXPECT_GT(caps, 80u);
}

TEST_P(SectionPlanesTest, AreAsExactFarFromTheOrigin) {
    const auto draw = [&](double3 center, SectionPlanes const& section) {
        Scene scene(stage.engine);
        stage.box.add(scene, stage.instance, glm::translate(double4x4(1), center));
        scene.add(SunLight{ .directionWorld = { -0.5f, -1, -0.6f }, .castsShadows = false });
        View view = stage.view;
        view.camera.worldFromView[3] += double4(center, 0);
        view.section = section;
        return test::renderLinear(stage.engine, scene, view);
    };
    const double3 far(36'000'000, -4'194'304, 12'582'912); // metres
    const std::vector<SectionPlanes> near = sectionsAt(double3(0)), there = sectionsAt(far);
    for (const size_t i : { size_t{ 1 }, size_t{ 3 }, size_t{ 5 } })
        EXPECT_LE(test::differingPixels(draw(double3(0), near[i]), draw(far, there[i])), 12u) << i;
}

TEST_P(SectionPlanesTest, WithoutADirectionCutNothing) {
    Scene scene(stage.engine);
    stage.box.add(scene, stage.instance, double4x4(1));
    scene.add(SunLight{ .directionWorld = { -0.5f, -1, -0.6f } });
    const Image whole = test::renderLinear(stage.engine, scene, stage.view);
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN(),
                     kEndless = std::numeric_limits<double>::infinity();
    stage.view.section.planes = { double4(0, 0, 0, 1),        double4(kNone, 0, 0, 0), double4(0, kEndless, 0, 0),
                                  double4(0, 0, 1, kEndless), double4(0, 1, 0, kNone), double4(1e-200, 0, 0, 0) };
    EXPECT_EQ(test::differingPixels(whole, test::renderLinear(stage.engine, scene, stage.view)), 0u);
    stage.view.section.planes[4] = double4(0, -1, 0, 0.2);
    EXPECT_GT(test::differingPixels(whole, test::renderLinear(stage.engine, scene, stage.view)), 100u);
}

TEST_P(SectionPlanesTest, AtAFaceCutAllOrNothing) {
    Scene scene(stage.engine);
    stage.box.add(scene, stage.instance, glm::rotate(double4x4(1), 0.3, double3(0, 1, 0)));
    const auto colors = [&] {
        return renderAovs(stage.engine, scene, stage.view, std::array{ Aov::BaseColor })->front();
    };
    const Image whole = colors();
    const auto empty = [](Image const& image) {
        return std::ranges::all_of(image.pixels, [](std::byte each) { return each == std::byte{}; });
    };
    for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
        stage.view.samples = samples;
        stage.view.section.planes[0] = sectionPlane({ 0, 1, 0 }, { 0, -1, 0 });
        EXPECT_EQ(colors().pixels, whole.pixels) << "all of the box lies in front";
        stage.view.section.planes[0] = sectionPlane({ 0, 1, 0 }, { 0, 1, 0 });
        EXPECT_TRUE(empty(colors())) << "all of the box lies behind";
    }
    stage.view.section.planes[0] = sectionPlane(stage.view.camera.position(), { 0.3, -0.2, 1 });
    EXPECT_TRUE(empty(colors())) << "the camera is in the plane, the box behind it";
}

TEST_P(SectionPlanesTest, LeaveWhatAPickFinds) {
    Scene scene(stage.engine);
    const Renderable box = stage.box.add(scene, stage.instance, double4x4(1));
    Renderer renderer(stage.engine);
    size_t caps = 0;
    for (SectionPlanes const& section : sectionsAt(double3(0))) {
        stage.view.section = section;
        for (uint32_t y = 1; y < kSectionSize.y; y += 5) {
            for (uint32_t x = 2; x < kSectionSize.x; x += 6) {
                const auto seenAt = [&](double2 at) {
                    const SectionRay ray = sectionRay(stage.view, at);
                    return seenOfCutBox(section, ray.origin, ray.along, 0.1);
                };
                if (isBesideEdge(seenAt, double2(x, y) + 0.5)) continue;
                const std::optional<SolidHit> seen = seenAt(double2(x, y) + 0.5);
                const PickHit hit = renderer.waitPick(renderer.pick(scene, stage.view, { x, y })).value();
                EXPECT_EQ(static_cast<bool>(hit), seen.has_value()) << x << ' ' << y;
                if (!seen || !hit) continue;
                EXPECT_EQ(hit.renderable, box);
                EXPECT_LT(glm::length(hit.positionWorld - seen->point), 2e-5) << x << ' ' << y << ' ' << seen->isCap;
                caps += seen->isCap;
            }
        }
    }
    EXPECT_GT(caps, 20u);
}

/// What caps are made of.
constexpr const char* kCutChalk = R"(material { name : chalk, shadingModel : lit, sectionPlanes : true }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.8);
} })";

/// A floor and a box of white chalk, cut at 0.31 m or only so high.
struct TwinStage {
    SectionStage& stage;
    Owned<Material> chalk = test::loadMaterial(stage.engine, kCutChalk);
    Owned<MaterialInstance> white = stage.engine.own(stage.engine.createInstance(chalk));
    SolidMesh small{ stage.engine, *makeBox({ .size = { 2, 1.31f, 2 } }) };
    SolidMesh floor{ stage.engine, *makeBox({ .size = { 12, 0.5f, 12 } }) };

    WhiteEnvironment sky{ stage.engine };

    Image draw(bool isCut, View view) {
        Scene scene(stage.engine);
        sky.light(scene, view.camera);
        floor.add(scene, white, glm::translate(double4x4(1), double3(0, -1.25, 0)));
        if (isCut)
            stage.box.add(scene, white, double4x4(1));
        else
            small.add(scene, white, glm::translate(double4x4(1), double3(0, -0.345, 0)));
        scene.add(SunLight{ .directionWorld = { -0.7f, -1, 0.4f } });
        scene.add(PointLight{ .positionWorld = { 1.5, 1.2, 2 }, .intensity = Candela{ 20'000 }, .rangeMeters = 10 });
        if (isCut) view.section.planes[2] = sectionPlane({ 0, 0.31, 0 }, { 0, -1, 0 });
        return test::renderLinear(stage.engine, scene, view);
    }
};

/// Pixels whose light differs by more than a hundredth.
size_t differentLight(Image const& a, Image const& b) {
    size_t pixels = 0;
    for (uint32_t y = 0; y < a.height; ++y)
        for (uint32_t x = 0; x < a.width; ++x) {
            const float4 one = test::halfPixel(a, x, y), other = test::halfPixel(b, x, y);
            pixels += glm::length(one - other) > 0.01f * (1 + glm::length(one));
        }
    return pixels;
}

TEST_P(SectionPlanesTest, LeaveTheLightAndTheShadowsOfAPartOfThatSize) {
    TwinStage twins{ stage };
    View view = stage.view;
    view.size = { 80, 64 };
    const auto expectAlike = [&](const char* what, size_t most) {
        EXPECT_LE(differentLight(twins.draw(true, view), twins.draw(false, view)), most) << what;
    };
    for (const ShadowFilter filter :
         { ShadowFilter::Off, ShadowFilter::Hard, ShadowFilter::Pcf3, ShadowFilter::Evsm }) {
        view.quality.shadows = filter;
        // Means of depths contain those of back faces behind the cap.
        expectAlike(toString(filter), filter == ShadowFilter::Evsm ? 120 : 40);
    }
    view.quality.shadows = ShadowFilter::Pcf3;
    view.effects.ambientOcclusion.enabled = true;
    expectAlike("occlusion", 60);
    view.effects.screenSpaceReflections.enabled = true;
    expectAlike("reflections", 80);
    view.effects.ambientOcclusion.enabled = view.effects.screenSpaceReflections.enabled = false;
    view.effects.contactShadows.distanceMeters = 0.3f;
    expectAlike("contact shadows", 60);
    view.effects.depthOfField = { .enabled = true, .focusMeters = 3, .blurScale = 30 };
    expectAlike("depth of field", 60);
    view.effects.depthOfField.enabled = false;
    view.samples = 4;
    expectAlike("several samples", 90); // along all edges
}

TEST_P(SectionPlanesTest, CostNothingWithoutAPlaneOrAReader) {
    const std::string text = sectioned("", "vec3(0.3, 0.5, 0.7)");
    std::string plainText = text;
    plainText.erase(plainText.find(", sectionPlanes : true"), 22);
    const Owned<Material> plain = test::loadMaterial(stage.engine, plainText),
                          cut = test::loadMaterial(stage.engine, text);
    const WhiteEnvironment sky(stage.engine);
    const auto draw = [&](Material const& material, View const& view, std::string* graph = nullptr) {
        const Owned<MaterialInstance> instance = stage.engine.own(stage.engine.createInstance(material));
        Scene scene(stage.engine);
        stage.box.add(scene, instance, double4x4(1));
        stage.box.add(scene, instance, glm::translate(double4x4(1), double3(0, -2.4, 0)));
        scene.add(SunLight{ .directionWorld = { -0.5f, -1, -0.6f } });
        sky.light(scene, view.camera);
        Renderer renderer(stage.engine);
        Image image = test::renderLinear(stage.engine, renderer, scene, view);
        if (graph) *graph = renderer.graphviz();
        return image;
    };
    for (const bool readsDepth : { false, true }) {
        View view = stage.view;
        view.effects.ambientOcclusion.enabled = readsDepth;
        std::string ofPlain, ofCut;
        const Image expected = draw(plain, view, &ofPlain);
        EXPECT_EQ(test::differingPixels(expected, draw(cut, view, &ofCut)), 0u);
        EXPECT_EQ(ofPlain, ofCut);
        view.section.planes[0] = double4(0, -1, 0, 0.4);
        EXPECT_EQ(test::differingPixels(expected, draw(plain, view, &ofCut)), 0u) << "without sectionPlanes";
        EXPECT_EQ(ofPlain, ofCut);
        EXPECT_GT(test::differingPixels(expected, draw(cut, view, &ofCut)), 100u);
        EXPECT_EQ(ofPlain == ofCut, !readsDepth) << "caps have passes only where an effect reads depths";
    }
}

TEST(SectionPlanes, HaveTheSameBitsOnBothApis) {
    const std::vector<Image> images = test::sameOnBothApis<SectionStage>([](SectionStage& stage) {
        std::vector<Image> drawn;
        Scene scene(stage.engine);
        stage.box.add(scene, stage.instance, glm::rotate(double4x4(1), 0.3, double3(0.2, 1, 0)));
        stage.box.add(scene, stage.instance, glm::translate(double4x4(0.5), double3(0.6, 0.1, 0.4)));
        scene.add(SunLight{ .directionWorld = { -0.5f, -1, -0.6f } });
        for (SectionPlanes const& section : sectionsAt(double3(0))) {
            stage.view.section = section;
            stage.view.section.hatchMeters = 0.2f;
            for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
                stage.view.samples = samples;
                stage.view.effects.ambientOcclusion.enabled = samples == 1;
                drawn.push_back(test::renderLinear(stage.engine, scene, stage.view));
            }
        }
        return drawn;
    });
    EXPECT_EQ(images.size(), 14u);
}

} // namespace
} // namespace filament_core
