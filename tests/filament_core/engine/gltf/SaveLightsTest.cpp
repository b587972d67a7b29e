// SPDX-License-Identifier: Apache-2.0
// Lights of saved scenes: every value of every light comes back, and the pixels are the same.
#include "filament_core/engine/SceneImpl.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/SaveGltf.h>

#include <gmock/gmock.h>

namespace filament_core {
namespace {

namespace fs = std::filesystem;
using scene::LightRecord;
using testing::IsEmpty;

constexpr Exposure kLampExposure{ .aperture = 1, .shutterSeconds = 1.2f, .iso = 100 }; // of factor 1

template <class T>
using ChangesOfLight = std::vector<std::pair<const char*, std::function<void(T&)>>>;

#define CHANGE(TYPE, MEMBER, ...)                                                                                      \
    {                                                                                                                  \
#MEMBER, [](TYPE & light) { light.MEMBER = __VA_ARGS__; }                                                      \
    }

// A new member of a light does not compile below: give it a row.
ChangesOfLight<SunLight> changesOf(SunLight const& rest) {
    [[maybe_unused]] auto const& [direction, illuminance, color, radius, disc, halo, falloff, shadows, contact,
                                  channels, cookie, meters, offset, up] = rest;
    return { CHANGE(SunLight, directionWorld, { 0.3f, -0.8f, 0.123f }),
             CHANGE(SunLight, illuminance, Lux{ 12'345.6f }),
             CHANGE(SunLight, color, { 0.1f, 2.7f, 0.3f }),
             CHANGE(SunLight, angularRadiusDegrees, 1.37f),
             CHANGE(SunLight, showsDisc, true),
             CHANGE(SunLight, haloSize, 17.3f),
             CHANGE(SunLight, haloFalloff, 12.7f),
             CHANGE(SunLight, castsShadows, false),
             CHANGE(SunLight, contactShadows, true),
             CHANGE(SunLight, lightChannels, 0x85) };
}

template <class Punctual>
ChangesOfLight<Punctual> punctualChanges() {
    return { CHANGE(Punctual, positionWorld, { 1e7 + 0.1, -0.3, 2 }),
             CHANGE(Punctual, intensity, Candela{ 12.3f }),
             CHANGE(Punctual, color, { 1.1f, 0.7f, 0 }),
             CHANGE(Punctual, rangeMeters, 7.7f),
             CHANGE(Punctual, sourceRadiusMeters, 0.13f),
             CHANGE(Punctual, castsShadows, false),
             CHANGE(Punctual, contactShadows, true),
             CHANGE(Punctual, lightChannels, 0) };
}

ChangesOfLight<PointLight> changesOf(PointLight const& rest) {
    [[maybe_unused]] auto const& [position, intensity, color, range, radius, shadows, contact, channels, profile,
                                  cookie, direction, up] = rest;
    return punctualChanges<PointLight>();
}

ChangesOfLight<SpotLight> changesOf(SpotLight const& rest) {
    [[maybe_unused]] auto const& [position, direction, intensity, color, range, inner, outer, radius, shadows, contact,
                                  channels, profile, cookie, up] = rest;
    ChangesOfLight<SpotLight> all = punctualChanges<SpotLight>();
    all.push_back(CHANGE(SpotLight, directionWorld, { 0.3f, 0.77f, -0.123f }));
    all.push_back(CHANGE(SpotLight, innerConeRadians, 0.37f));
    all.push_back(CHANGE(SpotLight, outerConeRadians, 1.5707964f));
    return all;
}

template <class Area>
ChangesOfLight<Area> areaChanges() {
    return { CHANGE(Area, positionWorld, { 1e7 + 0.1, -0.3, 2 }),
             CHANGE(Area, luminance, Nits{ 12.3f }),
             CHANGE(Area, color, { 1.1f, 0.7f, 0 }),
             CHANGE(Area, rangeMeters, 7.7f),
             CHANGE(Area, castsShadows, false),
             CHANGE(Area, isVisible, true),
             CHANGE(Area, lightChannels, 6) };
}

ChangesOfLight<RectLight> changesOf(RectLight const& rest) {
    [[maybe_unused]] auto const& [position, direction, up, width, height, image, luminance, color, range, twoSided,
                                  shadows, visible, channels] = rest;
    ChangesOfLight<RectLight> all = areaChanges<RectLight>();
    all.push_back(CHANGE(RectLight, directionWorld, { 0.3f, 0.77f, -0.123f }));
    all.push_back(CHANGE(RectLight, upWorld, { 0.3f, 0.1f, 5 }));
    all.push_back(CHANGE(RectLight, widthMeters, 0.33f));
    all.push_back(CHANGE(RectLight, heightMeters, 0));
    all.push_back(CHANGE(RectLight, isTwoSided, true));
    return all;
}

ChangesOfLight<DiscLight> changesOf(DiscLight const& rest) {
    [[maybe_unused]] auto const& [position, direction, radius, luminance, color, range, twoSided, shadows, visible,
                                  channels] = rest;
    ChangesOfLight<DiscLight> all = areaChanges<DiscLight>();
    all.push_back(CHANGE(DiscLight, directionWorld, { 0.3f, 0.77f, -0.123f }));
    all.push_back(CHANGE(DiscLight, radiusMeters, 0.33f));
    all.push_back(CHANGE(DiscLight, isTwoSided, true));
    return all;
}

ChangesOfLight<TubeLight> changesOf(TubeLight const& rest) {
    [[maybe_unused]] auto const& [position, axis, length, radius, luminance, color, range, shadows, visible, channels] =
            rest;
    ChangesOfLight<TubeLight> all = areaChanges<TubeLight>();
    all.push_back(CHANGE(TubeLight, axisWorld, { 0.3f, 0.77f, -0.123f }));
    all.push_back(CHANGE(TubeLight, lengthMeters, 3.3f));
    all.push_back(CHANGE(TubeLight, radiusMeters, 0.77f));
    return all;
}

#undef CHANGE

/// A light of each kind as it is, and with each of its values changed alone.
std::vector<std::pair<std::string, LightDesc>> everyLight() {
    std::vector<std::pair<std::string, LightDesc>> all;
    const auto add = [&]<class T>(const char* kind, T const& rest) {
        all.emplace_back(kind, rest);
        for (auto const& [member, change] : changesOf(rest)) {
            T light = rest;
            change(light);
            all.emplace_back(std::string(kind) + "." + member, light);
        }
    };
    add("sun", SunLight{});
    add("point", PointLight{});
    add("spot", SpotLight{});
    add("rect", RectLight{});
    add("disc", DiscLight{});
    add("tube", TubeLight{});
    return all;
}

/// All members of a light of a scene that its kind uses, as text.
std::string textOf(LightRecord const& light) {
    auto const& [type, position, direction, color, intensity, range, inner, outer, radius, casts, contact, channels,
                 isTwoSided, isVisible, side, extent, profile, image, scale, offset, disc, haloSize, falloff] = light;
    const bool isTube = type == LightRecord::Type::Tube, isPoint = type == LightRecord::Type::Point;
    const auto of = [](auto const& v) { return fmt::format("({:a} {:a} {:a})", v.x + 0, v.y + 0, v.z + 0); }; // no -0
    return fmt::format("{} at {} to {} {} {:a} {:a} {:a} {:a} {:a} {} {} {} {} {} {} {:a} {:a} {} {} {:a} {:a} {:a} "
                       "{:a} {} {:a} {:a}",
                       static_cast<int>(type), of(position), isTube || isPoint ? "" : of(direction), of(color),
                       intensity, range, inner, outer, radius, casts, contact, channels, isTwoSided, isVisible,
                       light.isArea() ? of(side) : "", extent.x, extent.y, profile != nullptr, image != nullptr,
                       scale.x, scale.y, offset.x, offset.y, disc, haloSize, falloff);
}

std::vector<std::string> lightsOf(Scene const& scene) {
    std::vector<std::string> all;
    scene.impl().upToDate();
    for (LightRecord const& light : scene.impl().data.lights.records) all.push_back(textOf(light));
    return all;
}

TEST(SavedLights, EveryValueComesBackToTheBit) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 1 });
    ASSERT_TRUE(engine) << engine.error().message;
    const fs::path file = test::folderOfThisTest() / "lights.gltf";
    Scene scene(*engine);
    const auto all = everyLight();
    for (auto const& [name, light] : all) scene.add(light);
    const auto saved = saveGltf(scene, file);
    ASSERT_TRUE(saved) << saved.error().message;
    EXPECT_THAT(saved->warnings, IsEmpty());
    const auto model = loadGltf(*engine, file);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_THAT(model->warnings(), IsEmpty());
    Scene again(*engine);
    again.add(*model);
    const std::vector<std::string> before = lightsOf(scene), after = lightsOf(again);
    ASSERT_EQ(after.size(), all.size());
    for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(after[i], before[i]) << all[i].first;
    for (size_t i = 1; i < all.size(); ++i)
        EXPECT_NE(before[i], before[i - 1]) << all[i].first << ": the change is one that the scene sees";
    // What nobody changed is the part of the file that it was.
    ASSERT_TRUE(saveGltf(again, file));
    const auto twice = loadGltf(*engine, file);
    ASSERT_TRUE(twice);
    Scene third(*engine);
    third.add(*twice);
    EXPECT_EQ(lightsOf(third), before);
}

class SaveLights : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Apis, SaveLights, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return toString(test.param); });

/// A ball over a floor, as a model of a file.
Result<Model> stageIn(Engine& engine, fs::path const& file) {
    Scene scene(engine);
    const auto lit = engine.own(*createBuiltInMaterial(engine, "lit"));
    const auto paint = engine.own(engine.createInstance(lit, "paint"));
    const Mesh ball = *makeUvSphere(), floor = *makePlane({ .width = 6, .depth = 6 });
    std::vector<Owned<VertexBuffer>> vertices;
    std::vector<Owned<IndexBuffer>> indices;
    for (Mesh const* mesh : { &ball, &floor }) {
        vertices.push_back(engine.own(engine.create(mesh->vertexBuffer())));
        indices.push_back(engine.own(engine.create(mesh->indexBuffer())));
        double4x4 place(1.0);
        place[3].y = mesh == &ball ? 0.7 : 0;
        scene.add(RenderableDesc{
                .vertices = vertices.back(), .indices = indices.back(), .material = paint, .worldFromObject = place });
    }
    if (const auto saved = saveGltf(scene, file); !saved) return saved.error();
    return loadGltf(engine, file);
}

TEST_P(SaveLights, OfEveryKindDrawTheSamePixels) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const fs::path folder = test::folderOfThisTest();
    {
        const auto stage = stageIn(*engine, folder / "stage.glb");
        ASSERT_TRUE(stage) << stage.error().message;
        Scene scene(*engine);
        scene.add(*stage);
        scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 2 }, .contactShadows = true });
        scene.add(PointLight{ .positionWorld = { 2, 1.5, 0.3 }, .intensity = Candela{ 5 }, .castsShadows = false });
        scene.add(SpotLight{ .positionWorld = { 0, 3, 1 },
                             .directionWorld = { 0.1f, -3, -1 },
                             .intensity = Candela{ 20 },
                             .color = { 3, 1, 1 },
                             .sourceRadiusMeters = 0.2f });
        const Node holder = scene.add(
                NodeDesc{ .parentFromNode = double4x4(glm::dmat3{ { 0.6, 0, -0.8 }, { 0, 1, 0 }, { 0.8, 0, 0.6 } }) });
        scene.add(RectLight{ .positionWorld = { -1.5, 1, 0 },
                             .directionWorld = { 1, -0.3f, 0.1f },
                             .luminance = Nits{ 4 },
                             .isVisible = true },
                  holder);
        scene.add(DiscLight{ .positionWorld = { 0.2, 2, -1 },
                             .directionWorld = { 0, -1, 0.7f },
                             .radiusMeters = 0.3f,
                             .luminance = Nits{ 9 } });
        scene.add(TubeLight{ .positionWorld = { 0, 0.3, 1.1 },
                             .axisWorld = { 1, 0.2f, 0 },
                             .luminance = Nits{ 30 },
                             .isVisible = true });
        View view{ .camera = Camera::lookAt({ 0.4, 1.8, 3.6 }, { 0, 0.6, 0 }, { .verticalFovDegrees = 50 },
                                            kLampExposure),
                   .size = { 96, 64 } };
        view.quality.shadows = ShadowFilter::Pcss;
        view.quality.areaShadows = AreaShadows::Shape;
        const Image before = test::renderLinear(*engine, scene, view);
        const auto saved = saveGltf(scene, folder / "lights.glb");
        ASSERT_TRUE(saved) << saved.error().message;
        EXPECT_THAT(saved->warnings, IsEmpty());
        const auto model = loadGltf(*engine, folder / "lights.glb");
        ASSERT_TRUE(model) << model.error().message;
        Scene again(*engine);
        again.add(*model);
        EXPECT_EQ(test::differingPixels(before, test::renderLinear(*engine, again, view)), 0u);
        EXPECT_GT(test::extremesOf(before).most, 0.5f);
    }
    test::expectNoErrors(*engine);
}

/// Coloured stripes.
Result<LightImage> colorStripes(Engine& engine, uint32_t width, uint32_t height, LightImageShape shape) {
    std::vector<uint8_t> texels;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            for (const uint32_t value : { x * 255 / width, y * 255 / height, (x ^ y) % 2 * 255, 255u })
                texels.push_back(static_cast<uint8_t>(value));
    return engine.create(LightImageDesc{
            .width = width, .height = height, .pixels = std::as_bytes(std::span(texels)), .shape = shape });
}

TEST_P(SaveLights, WithImagesAndProfilesDrawTheSamePixels) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const fs::path folder = test::folderOfThisTest();
    {
        const auto slide = engine->own(*colorStripes(*engine, 13, 7, LightImageShape::Projected));
        const auto clouds = engine->own(*colorStripes(*engine, 6, 9, LightImageShape::Tiled));
        const auto globe = engine->own(*colorStripes(*engine, 36, 6, LightImageShape::Cube));
        const auto screen = engine->own(*colorStripes(*engine, 16, 9, LightImageShape::Emitted));
        const std::string_view ies = "IES:LM-63-2019\nTILT=NONE\n1 -1 1 3 2 1 2 0 0 0\n1 1 9\n0 45 90\n0 90\n"
                                     "100 70 5\n100 80 9\n";
        const auto luminaire = engine->own(*engine->create(LightProfileDesc{ std::as_bytes(std::span(ies)), "lamp" }));
        const auto stage = stageIn(*engine, folder / "stage.glb");
        ASSERT_TRUE(stage) << stage.error().message;
        Scene scene(*engine);
        scene.add(*stage);
        scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f },
                            .illuminance = Lux{ 2 },
                            .cookie = clouds,
                            .cookieMeters = 1.7f,
                            .cookieOffsetMeters = { 0.3f, -0.1f },
                            .upWorld = { 0.2f, 0.1f, 1 } });
        scene.add(PointLight{ .positionWorld = { 2, 1.5, 0.3 },
                              .intensity = Candela{ 5 },
                              .cookie = globe,
                              .directionWorld = { -1, -0.3f, 0 } });
        scene.add(SpotLight{ .positionWorld = { 0, 3, 1 },
                             .directionWorld = { 0.1f, -3, -1 },
                             .intensity = Candela{ 20 },
                             .profile = luminaire,
                             .cookie = slide });
        scene.add(RectLight{ .positionWorld = { -1.5, 1, 0 },
                             .directionWorld = { 1, -0.3f, 0.1f },
                             .image = screen,
                             .luminance = Nits{ 4 },
                             .isVisible = true });
        const View view{ .camera = Camera::lookAt({ 0.4, 1.8, 3.6 }, { 0, 0.6, 0 }, { .verticalFovDegrees = 50 },
                                                  kLampExposure),
                         .size = { 96, 64 } };
        const Image before = test::renderLinear(*engine, scene, view);
        const auto saved = saveGltf(scene, folder / "lights.glb");
        ASSERT_TRUE(saved) << saved.error().message;
        EXPECT_THAT(saved->warnings, IsEmpty());
        const auto model = loadGltf(*engine, folder / "lights.glb");
        ASSERT_TRUE(model) << model.error().message;
        EXPECT_THAT(model->warnings(), IsEmpty());
        Scene again(*engine);
        again.add(*model);
        EXPECT_EQ(lightsOf(again), lightsOf(scene));
        EXPECT_EQ(test::differingPixels(before, test::renderLinear(*engine, again, view)), 0u);
        EXPECT_GT(test::extremesOf(before).most, 0.5f);
    }
    test::expectNoErrors(*engine);
}

} // namespace
} // namespace filament_core
