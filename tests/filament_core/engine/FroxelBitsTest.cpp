// SPDX-License-Identifier: Apache-2.0
// An image shaded with froxel lists has the bits of one in which every fragment tries every light. The second image
// comes from the same engine: an edit of its command stream takes the grid out of the uniforms.
#include "backend/layers/Captured.h"
#include "shaders/interface/LtcTable.h"
#include "shaders/interface/ShaderInterface.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <atomic>
#include <deque>

namespace filament_core {
namespace {

using prepare::Random;

/// While `isOn`, fragments find no grid, so they read all lights of the view. `halved`: the lists end early instead.
class OneList final : public backend::StreamEdit {
public:
    enum class Mode { Off, OneList, ShortLists };
    explicit OneList(std::shared_ptr<std::atomic<Mode>> mode) : mMode(std::move(mode)) {}

    void inspect(backend::CommandView commands) override {
        mPayloads.clear();
        replay(commands, *this);
    }
    void execute(auto const&) {}
    void execute(backend::CmdCreateBuffer const& command) {
        if (command.desc.debugName == "frame") mFrames.push_back(command.handle);
        if (command.desc.debugName == "froxels") mFroxels.push_back(command.handle);
    }

    using StreamEdit::edit;
    void edit(backend::CmdUpdateBuffer& command) override {
        const Mode mode = *mMode;
        if (mode == Mode::OneList && std::ranges::count(mFrames, command.buffer)) {
            const float4 none(0);
            std::memcpy(copy(command) + offsetof(shader::FrameUniforms, froxelGrid), &none, sizeof none);
        }
        const bool isTable = command.bytes.size() == sizeof(shader::kLtcTable);
        if (mode == Mode::ShortLists && std::ranges::count(mFroxels, command.buffer) && !isTable)
            shorten(copy(command));
    }

private:
    std::byte* copy(backend::CmdUpdateBuffer& command) {
        auto& own = mPayloads.emplace_back(command.bytes.begin(), command.bytes.end());
        command.bytes = own;
        return own.data();
    }
    /// Every list without its last light; the first list begins behind the words of the froxels.
    static void shorten(std::byte* bytes) {
        const std::span all(reinterpret_cast<uint32_t*>(bytes), 1);
        const uint32_t froxels = all[0] >> shader::kFroxelCountBits;
        for (uint32_t& word : std::span(all.data(), froxels)) word -= word % (1u << shader::kFroxelCountBits) ? 1 : 0;
    }

    std::shared_ptr<std::atomic<Mode>> mMode;
    std::vector<backend::BufferHandle> mFrames, mFroxels;
    std::deque<std::vector<std::byte>> mPayloads;
};

constexpr const char* kPlaster = R"(material { name : plaster, shadingModel : lit }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.7);
    material.roughness = 0.5;
} })";

/// Drawn elsewhere than where it is: fragments are not on the way from the camera to the point that they show.
constexpr const char* kShifted = R"(material { name : shifted, shadingModel : lit, vertexDomain : device }
vertex { void materialVertex(inout MaterialVertexInputs material) {
    material.clipSpaceTransform = mat4(0.5, 0.0, 0.0, 0.0, 0.0, -0.7, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.3, 0.2, 0.0, 1.0);
} }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.9, 0.5, 0.2);
    material.roughness = 0.3;
} })";

struct Stage {
    std::shared_ptr<std::atomic<OneList::Mode>> mode = std::make_shared<std::atomic<OneList::Mode>>(OneList::Mode::Off);
    Engine engine;
    test::SquareMesh square{ engine };
    Owned<Material> plaster = test::loadMaterial(engine, kPlaster), shifted = test::loadMaterial(engine, kShifted);
    Owned<MaterialInstance> plain = engine.own(engine.createInstance(plaster)),
                            elsewhere = engine.own(engine.createInstance(shifted));
    Renderer renderer{ engine };

    explicit Stage(Backend backend) : engine(open(backend, mode)) {}

    static Engine open(Backend backend, std::shared_ptr<std::atomic<OneList::Mode>> const& mode) {
        EngineOptions options{ .backend = backend, .workers = 1 };
        options.debug.capture = std::make_shared<backend::FrameCapture>(std::make_unique<OneList>(mode));
        return std::move(*Engine::create(options));
    }

    Image draw(Scene const& scene, View const& view, OneList::Mode with) {
        engine.waitIdle();
        *mode = with;
        return test::renderLinear(engine, renderer, scene, view);
    }
};

double3 somewhere(Random& random, double size) {
    return { random.within(-size, size), random.within(-size, size), random.within(-size, size) };
}

void addLamp(Scene& scene, Random& random, double3 origin, double scale) {
    const double3 at = origin + somewhere(random, 3) * scale;
    const double reach = std::exp(random.within(std::log(0.02), std::log(4)));
    const Candela intensity{ static_cast<float>(30'000 * reach * reach * scale * scale) };
    const LinearColor color{ float3(random.within(0, 1), random.within(0, 1), random.within(0, 1)) };
    const auto range = random.next() % 16 ? static_cast<float>(reach * scale) : 0.0f;
    if (random.next() % 2) {
        scene.add(PointLight{ .positionWorld = at, .intensity = intensity, .color = color, .rangeMeters = range });
        return;
    }
    const auto direction = float3(glm::normalize(somewhere(random, 1) + double3(0, 0, 1e-3)));
    const auto side = static_cast<float>(random.within(0, 0.3) * reach * scale);
    const Nits luminance{ intensity.value / std::max(side * side, 1e-12f) };
    if (const uint32_t kind = random.next() % 6; kind == 0) {
        scene.add(RectLight{ .positionWorld = at,
                             .directionWorld = direction,
                             .widthMeters = side,
                             .heightMeters = side,
                             .luminance = luminance,
                             .color = color,
                             .rangeMeters = range,
                             .isTwoSided = range > 1 });
        return;
    } else if (kind == 1) {
        scene.add(DiscLight{ .positionWorld = at,
                             .directionWorld = direction,
                             .radiusMeters = side,
                             .luminance = luminance,
                             .color = color,
                             .rangeMeters = range });
        return;
    } else if (kind == 2) {
        scene.add(TubeLight{ .positionWorld = at,
                             .axisWorld = direction,
                             .lengthMeters = side,
                             .radiusMeters = side * 0.1f,
                             .luminance = luminance,
                             .color = color,
                             .rangeMeters = range });
        return;
    }
    const auto cone = static_cast<float>(std::exp(random.within(std::log(1e-3), std::log(1.57))));
    scene.add(SpotLight{ .positionWorld = at,
                         .directionWorld = direction,
                         .intensity = intensity,
                         .color = color,
                         .rangeMeters = range,
                         .innerConeRadians = cone * 0.5f,
                         .outerConeRadians = cone });
}

/// Squares and lamps around a place, sometimes far from the origin, from millimetres to 10 km.
struct RandomScene {
    Scene scene;
    View view;

    RandomScene(Stage& stage, uint32_t seed) : scene(stage.engine) {
        Random random(seed);
        const double scale = seed % 4 ? 1 : std::exp(random.within(std::log(1e-3), std::log(1e4)));
        const double3 origin = seed % 5 ? double3(0) : somewhere(random, 1e7);
        for (int i = 0; i < 6; ++i) {
            const double3 at = origin + double3(random.within(-1, 1), random.within(-1, 1), -0.8 * i) * scale;
            stage.square.add(scene, i == 2 ? stage.elsewhere : stage.plain, at, (0.4 + 0.5 * i) * scale);
        }
        const uint32_t lamps = 4 + random.next() % 80;
        for (uint32_t i = 0; i < lamps; ++i) addLamp(scene, random, origin, scale);
        const double3 eye = origin + double3(random.within(-2, 2), random.within(-2, 2), random.within(0.5, 3)) * scale;
        view.camera = Camera::lookAt(eye, origin + somewhere(random, 1) * scale,
                                     { static_cast<float>(random.within(5, 150)), static_cast<float>(0.01 * scale) });
        view.size = { 32 + random.next() % 40, 24 + random.next() % 40 };
        if (seed % 3 == 0) view.quality.depthRange = DepthRange::Ordinary;
        if (seed % 7 == 0) view.quality.cameraRelative = seed % 5 == 0;
        if (seed % 6 == 0) view.samples = 4;
    }
};

class FroxelBits : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Apis, FroxelBits, testing::ValuesIn(test::kBothApis),
                         [](auto const& api) { return std::string(toString(api.param)); });

TEST_P(FroxelBits, RandomScenesHaveTheBitsOfOneList) {
    Stage stage(GetParam());
    uint32_t grids = 0, lit = 0;
    size_t noticed = 0;
    for (uint32_t seed = 1; seed <= 120; ++seed) {
        const RandomScene random(stage, seed);
        const Image lists = stage.draw(random.scene, random.view, OneList::Mode::Off);
        grids += stage.renderer.explain().find("longest list") != std::string::npos;
        const Image all = stage.draw(random.scene, random.view, OneList::Mode::OneList);
        ASSERT_EQ(test::differingPixels(lists, all), 0u) << "seed " << seed;
        lit += test::extremesOf(lists).most > 0;
        if (seed % 10 == 0)
            noticed += test::differingPixels(lists, stage.draw(random.scene, random.view, OneList::Mode::ShortLists));
    }
    EXPECT_GT(grids, 100u);
    EXPECT_GT(lit, 80u);
    EXPECT_GT(noticed, 400u) << "lists without their last lights are noticed";
    test::expectNoErrors(stage.engine);
}

TEST_P(FroxelBits, LittlestTokyoUnder4096LampsHasTheBitsOfOneList) {
    if (tools::assetDir().empty())
        GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set: the models are not beside the checkout";
    Stage stage(GetParam());
    auto model =
            loadGltf(stage.engine, std::filesystem::path(tools::assetDir()) / "models/LittlestTokyo/LittlestTokyo.glb");
    ASSERT_TRUE(model.ok()) << model.error().message;
    Scene scene(stage.engine);
    scene.add(*model, fitToUnitCube(model->bounds()));
    Random random(1);
    for (int i = 0; i < 4096; ++i) {
        scene.add(PointLight{ .positionWorld = somewhere(random, 0.4),
                              .intensity = Candela{ static_cast<float>(random.within(10, 600)) },
                              .color = LinearColor{ float3(random.within(0, 1), random.within(0, 1), 1) },
                              .rangeMeters = static_cast<float>(random.within(0.01, 0.07)) });
    }
    const View view{ .camera = Camera::lookAt({ 0.9, 0.6, 1.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 }),
                     .size = { 160, 90 } };
    const Image lists = stage.draw(scene, view, OneList::Mode::Off);
    EXPECT_NE(stage.renderer.explain().find("4096 of 4096 shine on what is visible"), std::string::npos)
            << stage.renderer.explain();
    EXPECT_EQ(stage.renderer.explain().find("are full"), std::string::npos) << stage.renderer.explain();
    EXPECT_EQ(test::differingPixels(lists, stage.draw(scene, view, OneList::Mode::OneList)), 0u);
    EXPECT_GT(test::differingPixels(lists, stage.draw(scene, view, OneList::Mode::ShortLists)), 50u)
            << "lists without their last lights are noticed";
}

struct Extreme {
    const char* name;
    double scale;    ///< of the square, in metres
    double distance; ///< of everything from the origin
    SpotLight lamp;  ///< relative to the square's centre
};

// A cone of 179 degrees has an outer angle of 89.5 degrees: glTF's and ours is the half.
std::vector<Extreme> extremes() {
    const auto cone = [](double degrees) { return static_cast<float>(degrees / 360 * 3.14159265358979); };
    const float3 down(0, 0, -1);
    return {
        { "a millimetre", 1e-3, 0, { { 0, 0, 5e-4 }, down, Candela{ 0.01f }, {}, 1e-3f, 0, cone(90) } },
        { "100 km", 1e5, 0, { { 0, 0, 5e4 }, down, Candela{ 1e9f }, {}, 1e5f, 0, cone(90) } },
        { "10^7 m away", 1, 1e7, { { 0, 0, 0.5 }, down, Candela{ 1e4f }, {}, 1, 0, cone(90) } },
        { "around the camera", 1, 0, { { 0, 0, 1 }, down, Candela{ 1e4f }, {}, 3, 0, cone(90) } },
        { "inside of the surface", 1, 0, { { 0, 0, 0 }, down, Candela{ 1e4f }, {}, 0.5f, 0, cone(90) } },
        { "unlimited", 1, 0, { { 0, 0, 0.5 }, down, Candela{ 1e4f }, {}, 0, 0, cone(90) } },
        { "smallest range", 1, 0, { { 0, 0, 1e-3 }, down, Candela{ 1e4f }, {}, 1e-30f, 0, cone(90) } },
        { "largest range", 1, 0, { { 0, 0, 0.5 }, down, Candela{ 1e4f }, {}, 1e30f, 0, cone(90) } },
        { "cone of 0.01 degrees", 1, 0, { { 0, 0, 0.5 }, down, Candela{ 1e4f }, {}, 1, 0, cone(0.01) } },
        { "cone of 179 degrees", 1, 0, { { 0, 0, 0.1 }, down, Candela{ 1e3f }, {}, 1, 0, cone(179) } },
        { "10^9 candela", 1, 0, { { 0, 0, 0.5 }, down, Candela{ 1e9f }, {}, 1, 0, cone(90) } },
    };
}

TEST_P(FroxelBits, ExtremeLightsHaveTheBitsOfOneListAndAreNumbers) {
    Stage stage(GetParam());
    for (Extreme const& extreme : extremes()) {
        Scene scene(stage.engine);
        const double3 origin(extreme.distance, -extreme.distance, extreme.distance / 2);
        stage.square.add(scene, stage.plain, origin, extreme.scale);
        SpotLight lamp = extreme.lamp;
        lamp.positionWorld += origin;
        scene.add(lamp);
        Random random(1);
        for (int i = 0; i < 8; ++i) { // so that there is a grid
            scene.add(PointLight{ .positionWorld = origin + somewhere(random, 1) * extreme.scale,
                                  .intensity = Candela{ static_cast<float>(extreme.scale * extreme.scale * 100) },
                                  .rangeMeters = static_cast<float>(0.3 * extreme.scale) });
        }
        const View view{ .camera = Camera::lookAt(origin + double3(0.1, 0.1, 1) * extreme.scale, origin,
                                                  { 80, static_cast<float>(0.01 * extreme.scale) }),
                         .size = { 48, 32 } };
        const Image lists = stage.draw(scene, view, OneList::Mode::Off);
        EXPECT_EQ(test::differingPixels(lists, stage.draw(scene, view, OneList::Mode::OneList)), 0u) << extreme.name;
        for (uint32_t i = 0; i < 48 * 32; ++i) {
            const float4 pixel = test::halfPixel(lists, i % 48, i / 48);
            ASSERT_FALSE(std::isnan(pixel.x + pixel.y + pixel.z)) << extreme.name;
        }
    }
}

TEST_P(FroxelBits, ExplainTellsOfFullFroxels) {
    Stage stage(GetParam());
    Scene scene(stage.engine);
    stage.square.add(scene, stage.plain);
    for (int i = 0; i < 300; ++i)
        scene.add(PointLight{ .positionWorld = { 0, 0, 0.1 }, .intensity = Candela{ 1.0f }, .rangeMeters = 0.5f });
    stage.draw(scene, test::SquareMesh::view(), OneList::Mode::Off);
    EXPECT_NE(stage.renderer.explain().find("are full: "), std::string::npos) << stage.renderer.explain();
}

} // namespace
} // namespace filament_core
