// SPDX-License-Identifier: Apache-2.0
// Frames that change what exists allocate nothing from the heap, on no thread: vertices, indices, texels, lights,
// nodes, parameters, visibility, animations, passes of the app.
#include "shaders/package/EngineMaterials.h"
#include "tests/faults/FailingAllocator.h"
#include "tests/faults/FaultStage.h"

#include <filament_core/Animator.h>
#include <filament_core/Gltf.h>
#include <filament_core/Mesh.h>

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <span>

namespace filament_core::test {
namespace {

constexpr int kWarmUp = 40, kWatchedFrames = 32, kLamps = 1000, kNodes = 64, kSide = 17;

/// A scene all of whose parts can change in every frame.
class SteadyStage {
public:
    explicit SteadyStage(int workers)
            : engine(*makeEngine({ .workers = workers, .validation = false }, driver)), scene(engine), renderer(engine),
              mesh(makePlane({ .widthSegments = kSide - 1, .depthSegments = kSide - 1 }).value()),
              vertices(engine.own(engine.create(mesh.vertexBuffer()))),
              indices(engine.own(engine.create(mesh.indexBuffer()))),
              picture(engine.own(engine.create(TextureDesc{ .width = 16, .height = 16, .levels = 5 }))),
              material(engine.own(*createBuiltInMaterial(engine, "litTextured"))),
              instance(engine.own(engine.createInstance(material))),
              model(loadGltf(engine, tools::sourceDir() / "tests/conformance/scenes/models/animated.gltf").value()),
              animator(model, scene, scene.add(model)),
              light(engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial("light") }))),
              depth(engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial("debug_depth") }))),
              ofLight(engine.own(engine.createInstance(light))),
              ofDepth(engine.own(engine.createInstance(depth))), passes{ { { ofLight, PassPlace::AfterOpaque },
                                                                           { ofDepth, PassPlace::Last } } },
              frames(engine.own(engine.create(SwapChainDesc{ .size = view.size }))) {
        EXPECT_TRUE(engine.set(instance, "baseColorMap", picture));
        view.postProcess = passes;
        for (int i = 0; i < kNodes; ++i) {
            nodes[static_cast<size_t>(i)] = scene.add(NodeDesc{});
            renderables[static_cast<size_t>(i)] = scene.add({ .vertices = vertices,
                                                              .indices = indices,
                                                              .material = instance,
                                                              .node = nodes[static_cast<size_t>(i)] });
        }
        for (Light& lamp : lamps) lamp = scene.add(PointLight{});
        scene.add(SunLight{});
    }

    void draw() { renderer.render(scene, view, frames); }

    View view{ .camera = Camera::lookAt({ 0, 3, 4 }, { 0, 0, 0 }), .size = { 32, 32 } };
    std::shared_ptr<backend::FaultInjector> driver = std::make_shared<backend::FaultInjector>();
    Engine engine;
    Scene scene;
    Renderer renderer;
    Mesh mesh;
    Owned<VertexBuffer> vertices;
    Owned<IndexBuffer> indices;
    Owned<Texture> picture;
    Owned<Material> material;
    Owned<MaterialInstance> instance;
    Model model; // properties of materials, lights, nodes and maps
    Animator animator;
    Owned<Material> light, depth; ///< of pictures
    Owned<MaterialInstance> ofLight, ofDepth;
    std::array<PostProcessPass, 2> passes; ///< the depths over the light
    Owned<SwapChain> frames;
    std::array<Node, kNodes> nodes;
    std::array<Renderable, kNodes> renderables;
    std::array<Light, kLamps> lamps;
};

struct Change {
    const char* name;
    void (*make)(SteadyStage& stage, int frame);
};

double heightOf(int frame, size_t i) {
    return 0.01 * static_cast<double>((static_cast<size_t>(frame) * 7 + i * 13) % 31);
}

void updateVertices(SteadyStage& stage, int frame) {
    for (size_t i = 0; i < stage.mesh.vertices.size(); ++i)
        stage.mesh.vertices[i].position.y = static_cast<float>(heightOf(frame, i));
    const auto all = std::as_bytes(std::span(stage.mesh.vertices));
    if (frame % 2 == 0) return stage.engine.update(stage.vertices, all);
    stage.engine.update(stage.vertices, all.first(sizeof(MeshVertex) * kSide), kSide);
}

void updateIndices(SteadyStage& stage, int) {
    std::vector<uint32_t>& indices = stage.mesh.indices;
    std::rotate(indices.begin(), indices.begin() + 3, indices.end());
    stage.engine.update(stage.indices, std::as_bytes(std::span(stage.mesh.indices)));
}

void updateTexels(SteadyStage& stage, int frame) {
    std::array<uint32_t, 16 * 16> texels{};
    texels.fill(0xff000000u + static_cast<uint32_t>(frame));
    stage.engine.update(stage.picture, { .pixels = std::as_bytes(std::span(texels)), .generateMips = true });
}

void setLights(SteadyStage& stage, int frame) {
    for (size_t i = 0; i < stage.lamps.size(); ++i) {
        const double3 place(0.1 * static_cast<double>(i % 32) - 1.6, heightOf(frame, i),
                            0.1 * static_cast<double>(i / 32) - 1.6);
        stage.scene.set(stage.lamps[i],
                        PointLight{ .positionWorld = place, .rangeMeters = 0.5f, .castsShadows = false });
    }
}

void moveNodes(SteadyStage& stage, int frame) {
    for (size_t i = 0; i < stage.nodes.size(); ++i) {
        double4x4 place(1);
        place[3] = double4(0.2 * static_cast<double>(i % 8), heightOf(frame, i), 0.2 * static_cast<double>(i / 8), 1);
        stage.scene.setTransform(stage.nodes[i], place);
    }
}

void setParameters(SteadyStage& stage, int frame) {
    EXPECT_TRUE(stage.engine.set(stage.instance, "roughness", heightOf(frame, 0)));
}

void setVisibility(SteadyStage& stage, int frame) {
    for (size_t i = 0; i < stage.renderables.size(); ++i)
        stage.scene.setVisible(stage.renderables[i], (static_cast<size_t>(frame) + i) % 3 != 0);
}

void animate(SteadyStage& stage, int frame) {
    const double seconds = 0.125 * (frame % 9); // what is hidden at rest appears
    if (frame % 2 == 0) return stage.animator.apply(0, seconds);
    stage.animator.crossFade(0, seconds, 0, 1 - seconds, 0.25);
}

void drawPasses(SteadyStage& stage, int frame) {
    stage.passes[0].place = frame % 2 == 0 ? PassPlace::AfterOpaque : PassPlace::AfterToneMapping;
}

constexpr std::array kChanges{
    Change{ "vertices", updateVertices },  Change{ "indices", updateIndices }, Change{ "texels", updateTexels },
    Change{ "lights", setLights },         Change{ "nodes", moveNodes },       Change{ "parameters", setParameters },
    Change{ "visibility", setVisibility }, Change{ "animations", animate },    Change{ "passes", drawPasses },
};

constexpr Change kNothing{ "nothing", [](SteadyStage&, int) {} };
constexpr Change kEverything{ "everything", [](SteadyStage& stage, int frame) {
                                 for (Change const& change : kChanges) change.make(stage, frame);
                             } };

void PrintTo(Change const& change, std::ostream* stream) { *stream << change.name; }

class SteadyFrames : public testing::TestWithParam<Change> {};
constexpr auto nameOf = [](auto const& test) { return std::string(test.param.name); };
INSTANTIATE_TEST_SUITE_P(Each, SteadyFrames, testing::ValuesIn(kChanges), nameOf);
INSTANTIATE_TEST_SUITE_P(All, SteadyFrames, testing::Values(kNothing, kEverything), nameOf);

TEST_P(SteadyFrames, AllocateNothing) {
    for (const int workers : { 0, 2 }) {
        SteadyStage stage(workers);
        int frame = 0;
        const auto draw = [&] {
            GetParam().make(stage, frame++);
            stage.draw();
        };
        stage.driver->arm({ .streamDelay = std::chrono::milliseconds(2) }); // the same number of frames is ahead
        while (frame < kWarmUp) draw();
        stage.driver->arm({});
        for (const Whose whose : { Whose::App, Whose::Driver, Whose::Jobs }) {
            AllocationFailure first(whose, 1);
            for (int i = 0; i < kWatchedFrames; ++i) draw();
            EXPECT_FALSE(first.stop()) << GetParam().name << ", " << workers << " workers, " << toString(whose) << ": "
                                       << AllocationFailure::lastSite();
        }
        EXPECT_TRUE(stage.engine.takeErrors().empty());
    }
}

} // namespace
} // namespace filament_core::test
