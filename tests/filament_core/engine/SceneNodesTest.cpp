// SPDX-License-Identifier: Apache-2.0
// Nodes through the public API: models are copies of the nodes of their files, and images follow nodes.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/scenes/Sphere.h"

#include "filament_core/assets/gltf/GltfWriter.h"

#include <unistd.h>

#include <atomic>
#include <cmath>
#include <fstream>

namespace filament_core {
namespace {

double4x4 movedBy(double3 offset, double scale = 1) {
    double4x4 matrix(scale);
    matrix[3] = double4(offset, 1);
    return matrix;
}

double4x4 turnedAroundY(double radians, double3 offset) {
    double4x4 matrix = movedBy(offset);
    matrix[0] = { std::cos(radians), 0, -std::sin(radians), 0 };
    matrix[2] = { std::sin(radians), 0, std::cos(radians), 0 };
    return matrix;
}

assets::GlbMesh sphereMesh() {
    const scenes::SphereMesh sphere = scenes::makeSphere(8, 16);
    assets::GlbPrimitive primitive;
    for (scenes::SphereVertex const& vertex : sphere.vertices) {
        primitive.positions.push_back(vertex.position);
        primitive.normals.push_back(vertex.position);
    }
    primitive.indices.assign(sphere.indices.begin(), sphere.indices.end());
    return { "sphere", { std::move(primitive) } };
}

/// car -> body -> lamp (a spot that shines back onto the wheels), car -> left wheel, right wheel (mirrored).
assets::GlbScene carScene() {
    double4x4 mirrored = movedBy({ 0.7, -0.3, 0.2 }, 0.3);
    mirrored[0] = -mirrored[0];
    assets::GlbScene scene;
    scene.meshes = { sphereMesh() };
    scene.lights = { { .name = "lamp", .type = assets::LightType::Spot, .intensity = 20'000 } };
    scene.nodes = { { .name = "car", .parentFromNode = turnedAroundY(0.3, { 0, 0, 0 }), .children = { 1, 3, 4 } },
                    { .name = "body", .parentFromNode = movedBy({ 0, 0.1, 0 }, 0.5), .mesh = 0, .children = { 2 } },
                    { .name = "lamp", .parentFromNode = turnedAroundY(0.2, { 0.2, 0.5, 3 }), .light = 0 },
                    { .name = "left wheel", .parentFromNode = movedBy({ -0.7, -0.3, 0.2 }, 0.3), .mesh = 0 },
                    { .name = "right wheel", .parentFromNode = mirrored, .mesh = 0 } };
    return scene;
}

/// A separate .glb for every test, deleted with it.
class GlbFile {
public:
    explicit GlbFile(assets::GlbScene const& scene) {
        static std::atomic<int> count = 0;
        mPath = std::filesystem::temp_directory_path() /
                ("nodes-" + std::to_string(getpid()) + "-" + std::to_string(count++) + ".glb");
        const auto bytes = assets::writeGlb(scene);
        EXPECT_TRUE(bytes.ok());
        std::ofstream(mPath, std::ios::binary)
                .write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
    }
    ~GlbFile() { std::filesystem::remove(mPath); }
    GlbFile(GlbFile const&) = delete;
    GlbFile& operator=(GlbFile const&) = delete;
    std::filesystem::path const& path() const { return mPath; }

private:
    std::filesystem::path mPath;
};

/// Without a device: queries of the scene.
struct SceneNodesTest : testing::Test {
    std::optional<Engine> engine = test::makeEngine(Backend::Null);

    Model load(assets::GlbScene const& glb) {
        const GlbFile file(glb);
        auto model = loadGltf(*engine, file.path());
        EXPECT_TRUE(model.ok()) << model.error().message;
        return std::move(*model);
    }
};

TEST_F(SceneNodesTest, AModelBecomesACopyOfTheNodesOfItsFile) {
    const Model model = load(carScene());
    Scene scene(*engine);
    const Node root = scene.add(model, movedBy({ 10, 0, 0 }));
    EXPECT_EQ(scene.nodeCount(), 6u);
    EXPECT_EQ(scene.renderableCount(), 3u);
    EXPECT_EQ(scene.lightCount(), 1u);
    EXPECT_EQ(scene.name(root), model.name());
    EXPECT_EQ(scene.parent(root), Node{});
    const Node car = scene.firstChild(root), body = scene.firstChild(car), lamp = scene.firstChild(body);
    EXPECT_EQ(scene.name(car), "car");
    EXPECT_EQ(scene.name(lamp), "lamp");
    EXPECT_EQ(scene.name(scene.nextSibling(body)), "left wheel");
    EXPECT_EQ(scene.findNode("right wheel"), scene.nextSibling(scene.nextSibling(body)));
    EXPECT_EQ(scene.findNode("spare wheel"), Node{});
    EXPECT_NEAR(scene.worldFromNode(lamp)[3].y, 0.1 + 0.5 * 0.5, 1e-7);
    EXPECT_EQ(scene.worldFromNode(car), movedBy({ 10, 0, 0 }) * scene.parentFromNode(car));
}

TEST_F(SceneNodesTest, SpotsOfAFileWithEqualConesAreAdded) {
    assets::GlbScene glb = carScene();
    glb.lights[0].innerConeRadians = glb.lights[0].outerConeRadians = 0.5f;
    const Model model = load(glb);
    Scene scene(*engine);
    scene.add(model);
    EXPECT_EQ(scene.lightCount(), 1u);
}

TEST_F(SceneNodesTest, DirectionsOfLightsHaveAnyLength) {
    Scene scene(*engine);
    for (const float length : { 1e-44f, 1e-30f, 1.0f, 1.8e19f, 3.4e38f }) {
        scene.add(SunLight{ .directionWorld = { 0, -length, 0 } });
        scene.add(SpotLight{ .directionWorld = { length, length, length } });
    }
    EXPECT_EQ(scene.lightCount(), 10u);
}

TEST_F(SceneNodesTest, CopiesOfAModelLiveAndDieOnTheirOwn) {
    const Model model = load(carScene());
    Scene scene(*engine);
    const Node first = scene.add(model), second = scene.add(model, movedBy({ 100, 0, 0 }));
    const Node wheel = scene.findNode("left wheel", second);
    EXPECT_NE(wheel, scene.findNode("left wheel", first));
    scene.remove(first);
    EXPECT_EQ(scene.nodeCount(), 6u);
    EXPECT_EQ(scene.renderableCount(), 3u);
    EXPECT_EQ(scene.lightCount(), 1u);
    EXPECT_GT(scene.bounds().min.x, 90.0);
    scene.remove(wheel);
    EXPECT_EQ(scene.renderableCount(), 2u);
    scene.remove(second);
    EXPECT_EQ(scene.nodeCount() + scene.renderableCount() + scene.lightCount(), 0u);
    EXPECT_TRUE(scene.bounds().empty());
}

TEST_F(SceneNodesTest, BoundsFollowNodesAndAgreeWithTheModels) {
    const Model model = load(carScene());
    Scene scene(*engine);
    const Node root = scene.add(model);
    const Box tight = model.bounds(), boxes = scene.bounds(); // of the vertices, and of the turned boxes of the parts
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(boxes.min[axis], tight.min[axis]);
        EXPECT_GE(boxes.max[axis], tight.max[axis]);
        EXPECT_LT(boxes.max[axis] - boxes.min[axis], 1.3 * (tight.max[axis] - tight.min[axis]));
    }
    scene.setTransform(root, movedBy({ 0, 1e7, 0 }));
    EXPECT_NEAR(scene.bounds().max.y, 1e7 + boxes.max.y, 1e-6);
}

TEST_F(SceneNodesTest, RenderablesAndLightsHangAtNodesAndWheelsRollOver) {
    Scene scene(*engine);
    const Model model = load(carScene());
    const Node car = scene.add(model), pole = scene.add(NodeDesc{ .parentFromNode = movedBy({ 5, 0, 0 }) });
    const Node wheel = scene.findNode("left wheel", car);
    const double4x4 before = scene.worldFromNode(wheel);
    scene.setParent(wheel, pole, Reparent::KeepWorld);
    for (int column = 0; column < 4; ++column) {
        EXPECT_NEAR(glm::length(scene.worldFromNode(wheel)[column] - before[column]), 0, 1e-12);
    }
    scene.setParent(wheel, pole);
    EXPECT_EQ(scene.parent(wheel), pole);
    const Light lamp = scene.add(PointLight{ .positionWorld = { 0, 1, 0 } }, pole);
    EXPECT_EQ(scene.node(lamp), pole);
    EXPECT_EQ(scene.node(scene.add(PointLight{})), Node{});
    scene.remove(pole);
    EXPECT_EQ(scene.renderableCount(), 2u);
    EXPECT_EQ(scene.lightCount(), 2u) << "the car's own, and the one without a node";
}

TEST_F(SceneNodesTest, AFileOfTwentyThousandLevelsIsAddedDrawnAndRemoved) {
    assets::GlbScene glb;
    glb.meshes = { sphereMesh() };
    constexpr uint32_t kDepth = 20'000;
    for (uint32_t i = 0; i < kDepth; ++i) {
        glb.nodes.push_back({ .name = "n", .parentFromNode = movedBy({ 0.5, 0, 0 }) });
        if (i + 1 < kDepth) glb.nodes.back().children = { i + 1 };
    }
    glb.nodes.back().mesh = 0;
    const Model model = load(glb);
    Scene scene(*engine);
    const Node root = scene.add(model);
    Renderer renderer(*engine);
    View view{ .camera = Camera::lookAt({ 1e4, 0, 5 }, { 1e4, 0, 0 }), .size = { 16, 16 } };
    ASSERT_TRUE(renderer.renderToImage(scene, view).ok());
    EXPECT_EQ(renderer.statistics().visible, 1u);
    EXPECT_EQ(scene.bounds().min.x, 1e4 - 1);
    scene.remove(root);
    EXPECT_EQ(scene.nodeCount(), 0u);
}

struct SceneNodesDeathTest : SceneNodesTest {
    SceneNodesDeathTest() { testing::GTEST_FLAG(death_test_style) = "threadsafe"; } // the engine has threads
};

TEST_F(SceneNodesDeathTest, NamesTheRuleThatWasBroken) {
    Scene scene(*engine);
    const Model model = load(carScene());
    const Node root = scene.add(model);
    EXPECT_DEATH(scene.setParent(root, scene.findNode("lamp")), "never its own ancestor");
    const scenes::Sphere sphere(*engine, scenes::makeSphere(4, 8));
    RenderableDesc part = sphere.renderable({}, movedBy({ 1, 0, 0 }));
    part.node = root;
    EXPECT_DEATH(scene.add(part), "its worldFromObject stays the identity");
}

/// With a device: images.
class SceneNodesImagesTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        mEngine = test::makeEngine(GetParam());
        ASSERT_TRUE(mEngine);
        const GlbFile file(carScene());
        auto model = loadGltf(*mEngine, file.path());
        ASSERT_TRUE(model.ok()) << model.error().message;
        mModel.emplace(std::move(*model));
    }

    std::vector<std::byte> render(Scene const& scene) {
        const View view{ .camera = Camera::lookAt({ 0.4, 0.6, 3 }, { 0.3, 0, 0 }, { .verticalFovDegrees = 45 }),
                         .size = { 96, 64 } };
        Renderer renderer(*mEngine);
        auto image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image.ok());
        test::expectNoErrors(*mEngine);
        return image ? std::move(image->pixels) : std::vector<std::byte>{};
    }

    std::optional<Engine> mEngine;
    std::optional<Model> mModel;
};

TEST_P(SceneNodesImagesTest, AModelMovedByItsRootLooksLikeOneAddedThere) {
    const double4x4 place = turnedAroundY(-0.4, { 0.3, 0.1, -0.5 });
    Scene added(*mEngine), moved(*mEngine), deep(*mEngine);
    added.add(*mModel, place);
    const Node root = moved.add(*mModel);
    const std::vector<std::byte> before = render(moved);
    moved.setTransform(root, place);
    const std::vector<std::byte> expected = render(added);
    EXPECT_EQ(render(moved), expected);
    EXPECT_NE(before, expected);

    // the same again below another node
    const Node stand = deep.add(NodeDesc{ .parentFromNode = place, .name = "stand" });
    const Node below = deep.add(*mModel);
    render(deep);
    deep.setParent(below, stand);
    EXPECT_EQ(render(deep), expected);
    deep.remove(stand);
    EXPECT_EQ(render(deep), render(Scene(*mEngine)));
}

TEST_P(SceneNodesImagesTest, PartsMoveByNameAndTheirLightsShineFromTheNewPlace) {
    Scene scene(*mEngine);
    scene.add(*mModel);
    const std::vector<std::byte> rest = render(scene);
    const Node wheel = scene.findNode("left wheel"), lamp = scene.findNode("lamp");
    const double4x4 wheelAtRest = scene.parentFromNode(wheel), lampAtRest = scene.parentFromNode(lamp);
    scene.setTransform(wheel, movedBy({ -0.5, 0.4, 0.4 }, 0.3));
    const std::vector<std::byte> wheelUp = render(scene);
    scene.setTransform(wheel, wheelAtRest);
    scene.setTransform(lamp, turnedAroundY(-0.2, { -0.6, 0.2, 2.5 }));
    const std::vector<std::byte> lampAside = render(scene);
    scene.setTransform(lamp, lampAtRest);
    EXPECT_NE(wheelUp, rest);
    EXPECT_NE(lampAside, rest);
    EXPECT_NE(lampAside, wheelUp);
    EXPECT_EQ(render(scene), rest);
}

INSTANTIATE_TEST_SUITE_P(BothApis, SceneNodesImagesTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST(SceneNodesImages, HaveTheSameBitsOnBothApisForAnyNumberOfWorkers) {
    const GlbFile file(carScene());
    std::vector<std::byte> reference;
    for (const Backend backend : test::kBothApis) {
        for (const int workers : { 0, 2 }) {
            auto engine = test::makeEngine(backend, workers);
            ASSERT_TRUE(engine);
            auto model = loadGltf(*engine, file.path());
            ASSERT_TRUE(model.ok());
            Scene scene(*engine);
            for (int i = 0; i < 600; ++i) scene.add(*model, turnedAroundY(i, { i % 9 - 4.0, i % 5 - 2.0, -i * 0.05 }));
            const View view{ .camera = Camera::lookAt({ 0, 0, 6 }, { 0, 0, 0 }), .size = { 96, 64 } };
            Renderer renderer(*engine);
            auto image = renderer.renderToImage(scene, view);
            ASSERT_TRUE(image.ok());
            if (reference.empty()) reference = image->pixels;
            EXPECT_EQ(image->pixels, reference) << toString(backend) << ", " << workers << " workers";
        }
    }
}

} // namespace
} // namespace filament_core
