// SPDX-License-Identifier: Apache-2.0
// Motion: whatever moves a surface, the frame knows where the last one showed it. DebugView::Motion is compared with
// what a pinhole says, and reflections follow objects.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace filament_core {
namespace {

using test::halfPixel;

constexpr float3 kStep(0.05f, 0.03f, 0); // metres a frame
constexpr double kDistance = 2;
constexpr uint2 kPanelSize(96, 64);
constexpr float kFovDegrees = 50;

float4x4 moved(float steps) { return glm::translate(float4x4(1.0f), kStep * steps); }

/// What moves in a test: a panel that fills the middle of the image.
class Panel {
public:
    Panel(Backend backend, std::string_view material)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              scene(engine), renderer(engine) {
        mMaterial = test::loadMaterial(engine, material);
        mInstance = engine.own(engine.createInstance(mMaterial));
        makeMesh();
        view.camera = cameraAt(float3(0));
        view.size = kPanelSize;
        view.debugView = DebugView::Motion;
    }
    ~Panel() { test::expectNoErrors(engine); }

    static Camera cameraAt(float3 offset) {
        const double3 at(offset);
        return Camera::lookAt(at + double3(0, 0, kDistance), at, { .verticalFovDegrees = kFovDegrees });
    }

    RenderableDesc desc() const {
        return { .vertices = mVertices,
                 .indices = mIndices,
                 .material = mInstance,
                 .bounds = Box{ double3(-1, -1, -0.01f), double3(1, 1, 0.01f) } };
    }
    void addPlain() { panel = scene.add(desc()); }
    void addSkinned() {
        skin = scene.add(SkinDesc{ .boneCount = 1 });
        RenderableDesc skinned = desc();
        skinned.skin = skin;
        panel = scene.add(skinned);
    }
    void addMorphed() {
        const std::array<float3, 4> displaced{ kStep, kStep, kStep, kStep };
        mTargets = engine.own(
                engine.create(MorphTargetsDesc{ .vertexCount = 4, .targets = { { .positions = displaced } } }));
        RenderableDesc morphed = desc();
        morphed.morphTargets = mTargets;
        panel = scene.add(morphed);
    }

    Image draw() { return test::renderLinear(engine, renderer, scene, view); }

    Engine engine;
    Scene scene;
    Renderer renderer;
    View view;
    Renderable panel;
    Skin skin;

private:
    void makeMesh() {
        struct Vertex {
            float3 position;
            float4 tangents{ 0, 0, 0, 1 };
            std::array<uint8_t, 4> joints{};
            float4 weights{ 1, 0, 0, 0 };
        };
        const std::array<Vertex, 4> vertices{
            { { { -1, -1, 0 } }, { { 1, -1, 0 } }, { { 1, 1, 0 } }, { { -1, 1, 0 } } }
        };
        constexpr std::array<uint16_t, 6> kIndices{ 0, 1, 2, 0, 2, 3 };
        mVertices = engine.own(engine.create(VertexBufferDesc{
                .vertexCount = 4,
                .stride = sizeof(Vertex),
                .attributes = { { Attribute::Position, VertexFormat::Float3, offsetof(Vertex, position) },
                                { Attribute::Tangents, VertexFormat::Float4, offsetof(Vertex, tangents) },
                                { Attribute::Joints, VertexFormat::UByte4, offsetof(Vertex, joints) },
                                { Attribute::Weights, VertexFormat::Float4, offsetof(Vertex, weights) } },
                .data = std::as_bytes(std::span(vertices)),
                .name = "panel" }));
        mIndices = engine.own(engine.create(
                IndexBufferDesc{ .indexCount = 6, .data = std::as_bytes(std::span(kIndices)), .name = "panel" }));
    }

    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
    Owned<VertexBuffer> mVertices;
    Owned<IndexBuffer> mIndices;
    Owned<MorphTargets> mTargets;
};

const std::string kPanelText = test::text("shadingModel : unlit", "material.baseColor = vec4(1.0);");
const std::string kMaskedPanelText =
        test::text("shadingModel : unlit, blending : masked",
                   "material.baseColor = vec4(1.0, 1.0, 1.0, fract(gl_FragCoord.x * 0.25));");

std::string vertexText(std::string_view properties, std::string_view code) {
    return test::text(properties, "material.baseColor = vec4(1.0);") +
           " vertex { void materialVertex(inout MaterialVertexInputs material) { " + std::string(code) + " } }";
}

/// Something that moves by kStep a frame, or does not seem to.
struct Mover {
    const char* name;
    std::string material;
    std::function<void(Panel&)> add;
    std::function<void(Panel&, float steps)> move;
    float steps = 1;   ///< on screen
    bool isOwn = true; ///< not that of the camera alone
};

std::vector<Mover> movers() {
    const auto plain = [](Panel& panel) { panel.addPlain(); };
    const auto place = [](Panel& panel, float steps) {
        panel.scene.setTransform(panel.panel, double4x4(moved(steps)));
    };
    const auto bones = [](Panel& panel, float steps) { panel.scene.setBones(panel.skin, std::array{ moved(steps) }); };
    const auto weights = [](Panel& panel, float steps) {
        panel.scene.setMorphWeights(panel.panel, std::array{ steps });
    };
    const auto time = [](Panel& panel, float steps) { panel.view.timeSeconds = steps; };
    const auto camera = [](Panel& panel, float steps) { panel.view.camera = Panel::cameraAt(kStep * steps); };
    const auto both = [=](Panel& panel, float steps) { place(panel, steps), camera(panel, steps); };
    const std::string waving = vertexText("shadingModel : unlit",
                                          "material.worldPosition.xyz += vec3(0.05, 0.03, 0.0) * getUserTime().x;");
    const std::string inView = vertexText("shadingModel : unlit, vertexDomain : view",
                                          "material.worldPosition = getWorldFromViewMatrix() * "
                                          "vec4(getPosition().xy, -2.0, 1.0);");
    return {
        { "a transform", kPanelText, plain, place },
        { "a transform, masked", kMaskedPanelText, plain, place },
        { "a skin", kPanelText, [](Panel& panel) { panel.addSkinned(); }, bones },
        { "morph targets", kPanelText, [](Panel& panel) { panel.addMorphed(); }, weights },
        { "a vertex block", waving, plain, time },
        { "a vertex block and a skin", vertexText("shadingModel : unlit", "material.worldPosition.x += 0.0;"),
          [](Panel& panel) { panel.addSkinned(); }, bones },
        { "a transform among copies that stay", kPanelText,
          [](Panel& panel) {
              for (const double x : { -5.0, 0.0, 5.0 }) {
                  const Renderable added = panel.scene.add(panel.desc());
                  panel.scene.setTransform(added, glm::translate(double4x4(1.0), double3(x, 0, 0)));
                  if (x == 0) panel.panel = added;
              }
          },
          place },
        { "the camera", kPanelText, plain, camera, -1, false },
        { "the camera and the panel", kPanelText, plain, both, 0 },
        { "a place in the view", inView, plain, camera, 0 },
        { "nothing", kPanelText, plain, [](Panel&, float) {}, 0, false },
    };
}

/// What kStep is in pixels, to the right and down.
float2 pixelsOfStep() {
    const double focal = kPanelSize.y / 2.0 / std::tan(glm::radians(kFovDegrees / 2.0));
    return float2(kStep.x, -kStep.y) * static_cast<float>(focal / kDistance);
}

float encoded(float linear) {
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// As debug_view.mat has it: pixels to the right and down, and whether the surface moved by itself.
struct Shown {
    float2 pixels;
    bool isOwn;
};
Shown shownAt(Image const& image, uint32_t x, uint32_t y) {
    const float4 color = halfPixel(image, x, y);
    return { (float2(encoded(color.x), encoded(color.y)) - 0.5f) * 32.0f, encoded(color.z) > 0.75f };
}

TEST(Motion, IsThatOfAPinholeWhateverMoves) {
    for (Mover const& mover : movers()) {
        std::vector<Image> images;
        for (const Backend backend : test::kBothApis) {
            Panel panel(backend, mover.material);
            mover.add(panel);
            Image last;
            for (const float steps : { 0.0f, 1.0f, 2.0f }) {
                mover.move(panel, steps);
                last = panel.draw();
            }
            const bool runs = panel.renderer.explain().find("1 in view moved") != std::string::npos;
            EXPECT_EQ(runs, mover.isOwn) << mover.name << '\n' << panel.renderer.explain();
            const uint32_t x = kPanelSize.x / 2 + 3, y = kPanelSize.y / 2; // where the masked one has not cut a hole
            const Shown shown = shownAt(last, x, y);
            EXPECT_EQ(shown.isOwn, mover.isOwn) << mover.name;
            for (int c = 0; c < 2; ++c)
                EXPECT_NEAR(shown.pixels[c], pixelsOfStep()[c] * mover.steps, 0.05f) << mover.name << ", axis " << c;
            images.push_back(std::move(last));
        }
        EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u) << mover.name;
    }
}

TEST(Motion, EndsWithTheMovement) {
    Panel panel(test::kBothApis[0], kPanelText);
    panel.addPlain();
    panel.draw();
    panel.scene.setTransform(panel.panel, double4x4(moved(1)));
    panel.draw();
    EXPECT_TRUE(panel.renderer.explain().find("1 in view moved") != std::string::npos);
    const Image still = panel.draw();
    EXPECT_TRUE(panel.renderer.explain().find("nothing in view moves by itself") != std::string::npos);
    EXPECT_FALSE(shownAt(still, kPanelSize.x / 2, kPanelSize.y / 2).isOwn);
}

/// What was not there, or is another object now, has no motion of its own.
TEST(Motion, IsNotThatOfAnotherObject) {
    Panel panel(test::kBothApis[0], kPanelText);
    panel.addPlain();
    panel.draw();
    panel.scene.remove(panel.panel);
    panel.addPlain();
    panel.scene.setTransform(panel.panel, double4x4(moved(1)));
    panel.draw();
    EXPECT_TRUE(panel.renderer.explain().find("nothing in view moves by itself") != std::string::npos);

    Scene other(panel.engine);
    const Renderable there = other.add(panel.desc());
    other.setTransform(there, double4x4(moved(2)));
    panel.renderer.render(other, panel.view,
                          panel.engine.own(panel.engine.create(SwapChainDesc{ .size = kPanelSize })));
    EXPECT_TRUE(panel.renderer.explain().find("nothing in view moves by itself") != std::string::npos);
}

TEST(Motion, CostsNothingWithoutATemporalEffect) {
    for (const Backend backend : test::kBothApis) {
        Panel panel(backend, kPanelText);
        panel.addPlain();
        panel.view.debugView = DebugView::None;
        panel.view.effects.screenSpaceReflections.enabled = true; // nothing reflects
        panel.draw();
        const FrameStatistics still = panel.renderer.statistics();
        panel.scene.setTransform(panel.panel, double4x4(moved(1)));
        panel.draw();
        const FrameStatistics moving = panel.renderer.statistics();
        EXPECT_EQ(moving.draws, still.draws);
        EXPECT_EQ(moving.passesRun, still.passesRun);
        EXPECT_TRUE(panel.renderer.explain().find("no effect looks at the last picture") != std::string::npos);
    }
}

} // namespace
} // namespace filament_core
