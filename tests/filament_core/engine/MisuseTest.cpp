// SPDX-License-Identifier: Apache-2.0
// Size: a row for each public function that takes a handle.
// Every public function that takes a handle, with a handle that is null, whose object is gone, or of another engine or
// scene: the process ends with one line that names the function, the kind of object, its name, and what is wrong. And
// functions on another thread, of objects that were moved from, and of those that outlived their engine.
#include "tests/filament_core/engine/MisuseLine.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Animator.h>
#include <filament_core/BuiltInMaterials.h>
#include <filament_core/LightProfile.h>
#include <filament_core/LoadTicket.h>
#include <filament_core/ModelCopy.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>
#include <limits>
#include <thread>
#include <vector>

namespace filament_core {
namespace {

constexpr float4 kWhite{ 1 };
constexpr const char* kProfile = "IESNA:LM-63-2002\nTILT=NONE\n1 100 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n100 50\n";
constexpr const char* kShopPaint = R"(material { name : paint, shadingModel : unlit,
    parameters : [ { type : float4, name : tint }, { type : sampler2d, name : picture } ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor = materialParams.tint + texture(materialParams_picture, vec2(0.5)); } })";

/// One of everything that a handle can name.
struct Handles {
    Texture texture, depth;
    VertexBuffer vertices;
    IndexBuffer indices;
    MorphTargets targets;
    Material material;
    MaterialInstance instance;
    IndirectLight light;
    Skybox skybox;
    LightProfile profile;
    LightImage cookie;
    RenderTarget target;
    SwapChain chain;
    Renderable renderable;
    Light lamp;
    Skin skin;
    Node node;
};

template <class T>
T made(T handle) {
    EXPECT_TRUE(handle);
    return handle;
}

class World {
public:
    World() : engine(std::move(*Engine::create({ .backend = Backend::Null, .workers = 0 }))), scene(engine) {
        all = make(engine, scene);
    }
    ~World() { destroy(engine, scene, all); }

    static Handles make(Engine& engine, Scene& scene) {
        Handles all;
        makeResources(engine, all);
        all.node = made(scene.add(NodeDesc{ .name = "arm" }));
        all.renderable =
                made(scene.add({ .vertices = all.vertices, .indices = all.indices, .material = all.instance }));
        all.lamp = made(scene.add(PointLight{}));
        all.skin = made(scene.add(SkinDesc{ .boneCount = 1 }));
        return all;
    }

    static void destroy(Engine& engine, Scene& scene, Handles const& all) {
        scene.remove(all.renderable);
        scene.remove(all.lamp);
        scene.remove(all.skin);
        scene.remove(all.node);
        engine.destroy(all.target), engine.destroy(all.chain), engine.destroy(all.light), engine.destroy(all.skybox);
        engine.destroy(all.instance), engine.destroy(all.material), engine.destroy(all.targets);
        engine.destroy(all.vertices), engine.destroy(all.indices), engine.destroy(all.profile);
        engine.destroy(all.cookie);
        engine.destroy(all.texture), engine.destroy(all.depth);
    }

    Engine engine;
    Scene scene;
    Handles all;

private:
    static void makeResources(Engine& engine, Handles& all) {
        const std::array<float3, 3> points{ float3(0), float3(1, 0, 0), float3(0, 1, 0) };
        const std::array<uint16_t, 3> order{ 0, 1, 2 };
        all.texture = made(engine.create(TextureDesc{ .width = 4, .height = 4, .renderable = true, .name = "wood" }));
        all.depth = made(engine.create(
                TextureDesc{ .format = Format::R32F, .width = 4, .height = 4, .renderable = true, .name = "depths" }));
        all.vertices =
                made(engine.create(VertexBufferDesc{ .vertexCount = 3,
                                                     .stride = sizeof(float3),
                                                     .attributes = { { Attribute::Position, VertexFormat::Float3, 0 } },
                                                     .data = std::as_bytes(std::span(points)),
                                                     .name = "corners" }));
        all.indices = made(engine.create(
                IndexBufferDesc{ .indexCount = 3, .data = std::as_bytes(std::span(order)), .name = "order" }));
        all.targets = made(engine.create(
                MorphTargetsDesc{ .vertexCount = 3, .targets = { { .positions = points } }, .name = "smile" }));
        all.material =
                made(*engine.create(MaterialDesc{ .package = test::compiledPackage(kShopPaint), .name = "paint" }));
        all.instance = made(engine.createInstance(all.material, "red"));
        all.light = made(engine.create(IndirectLightDesc{ .specular = all.texture, .name = "day" }));
        all.skybox = made(engine.create(SkyboxDesc{ .cube = all.texture, .name = "blue" }));
        all.profile = made(*engine.create(LightProfileDesc{
                .file = std::as_bytes(std::span(kProfile, std::strlen(kProfile))), .name = "spotty" }));
        all.cookie = made(*engine.create(LightImageDesc{ .width = 1,
                                                         .height = 1,
                                                         .format = Format::RGBA32F,
                                                         .pixels = std::as_bytes(std::span(&kWhite, 1)),
                                                         .name = "gobo" }));
        all.target = made(engine.create(RenderTargetDesc{ .color = all.texture, .name = "mirror" }));
        all.chain = made(engine.create(SwapChainDesc{ .size = { 4, 4 }, .name = "shop" }));
    }
};

/// A function, and what it is given besides the bad handle: `good` is all of the world's own.
struct Use {
    const char* call;
    const char* kind;
    const char* name; ///< of the object that is gone; of a scene: its handles only
    std::function<void(World& world, Handles const& bad)> run;
    bool acceptsNull = false;
};

RenderableDesc descOf(Handles const& all) {
    return { .vertices = all.vertices, .indices = all.indices, .material = all.instance, .name = "ball" };
}

RenderableDesc with(World& world, std::function<void(RenderableDesc&)> change) {
    RenderableDesc desc = descOf(world.all);
    change(desc);
    return desc;
}

std::vector<Use> usesOfTextures() {
    return {
        { "Engine::destroy(EngineObject)", "texture", "wood",
          [](World& world, Handles const& bad) { world.engine.destroy(bad.texture); }, true },
        { "Engine::set(MaterialInstance, ParameterKey, Texture, Sampler) of 'picture'", "texture", "wood",
          [](World& world, Handles const& bad) {
              (void)world.engine.set(world.all.instance, "picture", bad.texture);
          } },
        { "Engine::create(IndirectLightDesc) of 'x'", "texture", "wood",
          [](World& world, Handles const& bad) {
              world.engine.create(IndirectLightDesc{ .specular = bad.texture, .name = "x" });
          } },
        { "Engine::create(IndirectLightDesc) of 'x'", "texture", "wood",
          [](World& world, Handles const& bad) {
              world.engine.create(
                      IndirectLightDesc{ .specular = world.all.texture, .irradiance = bad.texture, .name = "x" });
          },
          true },
        { "Engine::update(Texture, TextureUpdate)", "texture", "wood",
          [](World& world, Handles const& bad) { world.engine.update(bad.texture, {}); } },
        { "Engine::create(SkyboxDesc) of 'x'", "texture", "wood",
          [](World& world, Handles const& bad) {
              world.engine.create(SkyboxDesc{ .cube = bad.texture, .name = "x" });
          } },
        { "Engine::create(RenderTargetDesc) of 'x'", "texture", "depths",
          [](World& world, Handles const& bad) {
              world.engine.create(RenderTargetDesc{ .color = world.all.texture, .depth = bad.depth, .name = "x" });
          },
          true },
    };
}

std::vector<Use> usesOfGeometry() {
    return {
        { "Engine::destroy(EngineObject)", "vertex buffer", "corners",
          [](World& world, Handles const& bad) { world.engine.destroy(bad.vertices); }, true },
        { "Engine::destroy(EngineObject)", "index buffer", "order",
          [](World& world, Handles const& bad) { world.engine.destroy(bad.indices); }, true },
        { "Engine::destroy(EngineObject)", "morph targets", "smile",
          [](World& world, Handles const& bad) { world.engine.destroy(bad.targets); }, true },
        { "Engine::update(VertexBuffer, span<byte>, uint32_t, uint32_t)", "vertex buffer", "corners",
          [](World& world, Handles const& bad) { world.engine.update(bad.vertices, {}); } },
        { "Engine::update(IndexBuffer, span<byte>, uint32_t)", "index buffer", "order",
          [](World& world, Handles const& bad) { world.engine.update(bad.indices, {}); } },
        { "Scene::setGeometry(Renderable, GeometryDesc)", "vertex buffer", "corners",
          [](World& world, Handles const& bad) {
              world.scene.setGeometry(world.all.renderable, { .vertices = bad.vertices, .indices = world.all.indices });
          } },
        { "Scene::setGeometry(Renderable, GeometryDesc)", "index buffer", "order",
          [](World& world, Handles const& bad) {
              world.scene.setGeometry(world.all.renderable, { .vertices = world.all.vertices, .indices = bad.indices });
          } },
        { "Scene::add(RenderableDesc) of 'ball'", "vertex buffer", "corners",
          [](World& world, Handles const& bad) {
              world.scene.add(with(world, [&](RenderableDesc& desc) { desc.vertices = bad.vertices; }));
          } },
        { "Scene::add(RenderableDesc) of 'ball'", "index buffer", "order",
          [](World& world, Handles const& bad) {
              world.scene.add(with(world, [&](RenderableDesc& desc) { desc.indices = bad.indices; }));
          } },
        { "Scene::add(RenderableDesc) of 'ball'", "morph targets", "smile",
          [](World& world, Handles const& bad) {
              world.scene.add(with(world, [&](RenderableDesc& desc) { desc.morphTargets = bad.targets; }));
          },
          true },
        { "Engine::compile(Material, CompileDesc)", "vertex buffer", "corners",
          [](World& world, Handles const& bad) {
              (void)world.engine.compile(world.all.material, { .vertices = { bad.vertices } });
          } },
    };
}

std::vector<Use> usesOfMaterials() {
    return {
        { "Engine::destroy(EngineObject)", "material", "paint",
          [](World& world, Handles const& bad) { world.engine.destroy(bad.material); }, true },
        { "Engine::compile(Material, CompileDesc)", "material", "paint",
          [](World& world, Handles const& bad) { (void)world.engine.compile(bad.material); } },
        { "Engine::createInstance(Material, string)", "material", "paint",
          [](World& world, Handles const& bad) { world.engine.createInstance(bad.material); } },
        { "Engine::describe(Material)", "material", "paint",
          [](World& world, Handles const& bad) { (void)world.engine.describe(bad.material); } },
        { "Engine::findParameter(Material, string_view) of 'tint'", "material", "paint",
          [](World& world, Handles const& bad) { (void)world.engine.findParameter(bad.material, "tint"); } },
    };
}

std::vector<Use> usesOfInstances() {
    const auto use = [](const char* call, std::function<void(Engine&, MaterialInstance)> run,
                        bool acceptsNull = false) {
        return Use{ call, "material instance", "red",
                    [run = std::move(run)](World& world, Handles const& bad) { run(world.engine, bad.instance); },
                    acceptsNull };
    };
    return {
        use(
                "Engine::destroy(EngineObject)", [](Engine& e, MaterialInstance bad) { e.destroy(bad); }, true),
        use("Engine::set(MaterialInstance, ParameterKey, ParameterValue) of 'tint'",
            [](Engine& e, MaterialInstance bad) { (void)e.set(bad, "tint", ParameterValue(float4(1))); }),
        use("Engine::set(MaterialInstance, ParameterKey, ParameterArray, uint32_t) of 'tint'",
            [](Engine& e, MaterialInstance bad) {
                (void)e.set(bad, "tint", ParameterArray(std::span<const float4>()));
            }),
        use("Engine::set(MaterialInstance, ParameterKey, Texture, Sampler) of 'picture'",
            [](Engine& e, MaterialInstance bad) { (void)e.set(bad, "picture", Texture{}); }),
        use("Engine::setDoubleSided(MaterialInstance, bool)",
            [](Engine& e, MaterialInstance bad) { (void)e.setDoubleSided(bad, true); }),
        use("Engine::setCullingDisabled(MaterialInstance, bool)",
            [](Engine& e, MaterialInstance bad) { e.setCullingDisabled(bad, true); }),
        use("Engine::setCulling(MaterialInstance, Culling)",
            [](Engine& e, MaterialInstance bad) { e.setCulling(bad, Culling::None); }),
        use("Engine::setShadowCulling(MaterialInstance, optional<Culling>)",
            [](Engine& e, MaterialInstance bad) { e.setShadowCulling(bad, {}); }),
        use("Engine::setColorWrite(MaterialInstance, bool)",
            [](Engine& e, MaterialInstance bad) { e.setColorWrite(bad, true); }),
        use("Engine::setDepthWrite(MaterialInstance, bool)",
            [](Engine& e, MaterialInstance bad) { e.setDepthWrite(bad, true); }),
        use("Engine::setDepthCulling(MaterialInstance, bool)",
            [](Engine& e, MaterialInstance bad) { e.setDepthCulling(bad, true); }),
        use("Engine::setStencil(MaterialInstance, optional<StencilState>)",
            [](Engine& e, MaterialInstance bad) { e.setStencil(bad, {}); }),
        use("Engine::setMaskThreshold(MaterialInstance, float)",
            [](Engine& e, MaterialInstance bad) { (void)e.setMaskThreshold(bad, 0.5f); }),
        { "Scene::add(RenderableDesc) of 'ball'", "material instance", "red",
          [](World& world, Handles const& bad) {
              world.scene.add(with(world, [&](RenderableDesc& desc) { desc.material = bad.instance; }));
          } },
        { "Scene::setMaterial(Renderable, MaterialInstance)", "material instance", "red",
          [](World& world, Handles const& bad) { world.scene.setMaterial(world.all.renderable, bad.instance); } },
    };
}

std::vector<Use> usesOfLight() {
    return {
        { "Engine::destroy(EngineObject)", "indirect light", "day",
          [](World& world, Handles const& bad) { world.engine.destroy(bad.light); }, true },
        { "Engine::destroy(EngineObject)", "skybox", "blue",
          [](World& world, Handles const& bad) { world.engine.destroy(bad.skybox); }, true },
        { "Engine::destroy(EngineObject)", "light profile", "spotty",
          [](World& world, Handles const& bad) { world.engine.destroy(bad.profile); }, true },
        { "Engine::describe(LightProfile)", "light profile", "spotty",
          [](World& world, Handles const& bad) { (void)world.engine.describe(bad.profile); } },
        { "Engine::destroy(EngineObject)", "light image", "gobo",
          [](World& world, Handles const& bad) { world.engine.destroy(bad.cookie); }, true },
        { "Engine::describe(LightImage)", "light image", "gobo",
          [](World& world, Handles const& bad) { (void)world.engine.describe(bad.cookie); } },
        { "Scene::setIndirectLight(IndirectLight, Lux, float)", "indirect light", "day",
          [](World& world, Handles const& bad) { world.scene.setIndirectLight(bad.light, Lux{ 1 }); }, true },
        { "Scene::setSkybox(Skybox, Lux, float)", "skybox", "blue",
          [](World& world, Handles const& bad) { world.scene.setSkybox(bad.skybox, Lux{ 1 }); }, true },
        { "Scene::add(LightDesc, Node)", "light profile", "spotty",
          [](World& world, Handles const& bad) { world.scene.add(PointLight{ .profile = bad.profile }); }, true },
        { "Scene::add(LightDesc, Node)", "light profile", "spotty",
          [](World& world, Handles const& bad) { world.scene.add(SpotLight{ .profile = bad.profile }); }, true },
        { "Scene::add(LightDesc, Node)", "light image", "gobo",
          [](World& world, Handles const& bad) { world.scene.add(SpotLight{ .cookie = bad.cookie }); }, true },
    };
}

View smallView() { return { .size = { 4, 4 } }; }

std::vector<Use> usesOfTargets() {
    return {
        { "Engine::destroy(EngineObject)", "render target", "mirror",
          [](World& world, Handles const& bad) { world.engine.destroy(bad.target); }, true },
        { "Engine::destroy(EngineObject)", "swap chain", "shop",
          [](World& world, Handles const& bad) { world.engine.destroy(bad.chain); }, true },
        { "Engine::colorOf(RenderTarget)", "render target", "mirror",
          [](World& world, Handles const& bad) { (void)world.engine.colorOf(bad.target); } },
        { "Engine::depthOf(RenderTarget)", "render target", "mirror",
          [](World& world, Handles const& bad) { (void)world.engine.depthOf(bad.target); } },
        { "Renderer::render(Scene, View, RenderTarget)", "render target", "mirror",
          [](World& world, Handles const& bad) {
              Renderer(world.engine).render(world.scene, smallView(), bad.target);
          } },
        { "Renderer::render(Scene, View, SwapChain)", "swap chain", "shop",
          [](World& world, Handles const& bad) {
              Renderer(world.engine).render(world.scene, smallView(), bad.chain);
          } },
        { "Renderer::prewarm(Scene, View, RenderTarget)", "render target", "mirror",
          [](World& world, Handles const& bad) {
              Renderer(world.engine).prewarm(world.scene, smallView(), bad.target);
          } },
        { "Renderer::prewarm(Scene, View, SwapChain)", "swap chain", "shop",
          [](World& world, Handles const& bad) {
              Renderer(world.engine).prewarm(world.scene, smallView(), bad.chain);
          } },
        { "Renderer::render(Scene, MeshPass, RenderTarget, View)", "render target", "mirror",
          [](World& world, Handles const& bad) {
              Renderer(world.engine).render(world.scene, MeshPass{}, bad.target);
          } },
        { "Renderer::prewarm(MaterialInstance, RenderTarget, View)", "render target", "mirror",
          [](World& world, Handles const& bad) { Renderer(world.engine).prewarm(bad.instance, bad.target); } },
        { "Renderer::readPixels(RenderTarget)", "render target", "mirror",
          [](World& world, Handles const& bad) { (void)Renderer(world.engine).readPixels(bad.target); } },
        { "Renderer::readPixels(SwapChain)", "swap chain", "shop",
          [](World& world, Handles const& bad) { (void)Renderer(world.engine).readPixels(bad.chain); } },
        { "Engine::resize(SwapChain, uint2)", "swap chain", "shop",
          [](World& world, Handles const& bad) { world.engine.resize(bad.chain, uint2(2)); } },
        { "Renderer::present(SwapChain)", "swap chain", "shop",
          [](World& world, Handles const& bad) { Renderer(world.engine).present(bad.chain); } },
        { "Renderer::canPresent(SwapChain)", "swap chain", "shop",
          [](World& world, Handles const& bad) { (void)Renderer(world.engine).canPresent(bad.chain); } },
    };
}

std::vector<Use> usesOfRenderables() {
    const auto use = [](const char* call, std::function<void(Scene&, Renderable)> run) {
        return Use{ call, "renderable", "",
                    [run = std::move(run)](World& world, Handles const& bad) { run(world.scene, bad.renderable); } };
    };
    return {
        use("Scene::remove(Renderable)", [](Scene& s, Renderable bad) { s.remove(bad); }),
        { "Scene::setMaterial(Renderable, MaterialInstance)", "renderable", "",
          [](World& world, Handles const& bad) { world.scene.setMaterial(bad.renderable, world.all.instance); } },
        { "Scene::setGeometry(Renderable, GeometryDesc)", "renderable", "",
          [](World& world, Handles const& bad) {
              world.scene.setGeometry(bad.renderable, { .vertices = world.all.vertices, .indices = world.all.indices });
          } },
        use("Scene::setBounds(Renderable, Box)",
            [](Scene& s, Renderable bad) {
                s.setBounds(bad, { double3(0), double3(1) });
            }),
        use("Scene::bounds(Renderable)", [](Scene& s, Renderable bad) { (void)s.bounds(bad); }),
        use("Scene::setVisible(Renderable, bool)", [](Scene& s, Renderable bad) { s.setVisible(bad, true); }),
        use("Scene::isVisible(Renderable)", [](Scene& s, Renderable bad) { (void)s.isVisible(bad); }),
        use("Scene::setLightChannels(Renderable, LightChannels)",
            [](Scene& s, Renderable bad) { s.setLightChannels(bad, 1); }),
        use("Scene::setLayers(Renderable, Layers, Layers)", [](Scene& s, Renderable bad) { s.setLayers(bad, 1, 1); }),
        use("Scene::layers(Renderable)", [](Scene& s, Renderable bad) { (void)s.layers(bad); }),
        use("Scene::setDrawOrder(Renderable, DrawOrder)", [](Scene& s, Renderable bad) { s.setDrawOrder(bad, {}); }),
        use("Scene::drawOrder(Renderable)", [](Scene& s, Renderable bad) { (void)s.drawOrder(bad); }),
        use("Scene::setTransform(Renderable, double4x4)",
            [](Scene& s, Renderable bad) { s.setTransform(bad, double4x4(1)); }),
        use("Scene::setMorphWeights(Renderable, span<float>)",
            [](Scene& s, Renderable bad) { s.setMorphWeights(bad, {}); }),
        use("Scene::node(Renderable)", [](Scene& s, Renderable bad) { (void)s.node(bad); }),
    };
}

std::vector<Use> usesOfLampsAndSkins() {
    return {
        { "Scene::remove(Light)", "light", "", [](World& world, Handles const& bad) { world.scene.remove(bad.lamp); } },
        { "Scene::set(Light, LightDesc)", "light", "",
          [](World& world, Handles const& bad) { world.scene.set(bad.lamp, PointLight{}); } },
        { "Scene::setLightChannels(Light, LightChannels)", "light", "",
          [](World& world, Handles const& bad) { world.scene.setLightChannels(bad.lamp, 1); } },
        { "Scene::node(Light)", "light", "",
          [](World& world, Handles const& bad) { (void)world.scene.node(bad.lamp); } },
        { "Scene::remove(Skin)", "skin", "", [](World& world, Handles const& bad) { world.scene.remove(bad.skin); } },
        { "Scene::setBones(Skin, span<float4x4>)", "skin", "",
          [](World& world, Handles const& bad) { world.scene.setBones(bad.skin, {}); } },
        { "Scene::add(RenderableDesc) of 'ball'", "skin", "",
          [](World& world, Handles const& bad) {
              world.scene.add(with(world, [&](RenderableDesc& desc) { desc.skin = bad.skin; }));
          },
          true },
    };
}

std::vector<Use> usesOfNodes() {
    const auto use = [](const char* call, std::function<void(Scene&, Node)> run, bool acceptsNull = false) {
        return Use{ call, "node", "",
                    [run = std::move(run)](World& world, Handles const& bad) { run(world.scene, bad.node); },
                    acceptsNull };
    };
    return {
        use("ModelCopy::of(Scene, Node)", [](Scene& s, Node bad) { (void)ModelCopy::of(s, bad); }),
        use(
                "Scene::add(LightDesc, Node)", [](Scene& s, Node bad) { s.add(PointLight{}, bad); }, true),
        use(
                "Scene::add(NodeDesc) of 'x'",
                [](Scene& s, Node bad) { s.add(NodeDesc{ .parent = bad, .name = "x" }); }, true),
        use(
                "Scene::add(SkinDesc)", [](Scene& s, Node bad) { s.add(SkinDesc{ .node = bad, .boneCount = 1 }); },
                true),
        use("Scene::add(SkinDesc)",
            [](Scene& s, Node bad) {
                const Node joints[] = { bad };
                const float4x4 matrices[] = { float4x4(1) };
                s.add(SkinDesc{ .joints = joints, .jointFromBind = matrices });
            }),
        { "Scene::add(RenderableDesc) of 'ball'", "node", "",
          [](World& world, Handles const& bad) {
              world.scene.add(with(world, [&](RenderableDesc& desc) { desc.node = bad.node; }));
          },
          true },
        use("Scene::remove(Node)", [](Scene& s, Node bad) { s.remove(bad); }),
        use("Scene::setTransform(Node, double4x4)", [](Scene& s, Node bad) { s.setTransform(bad, double4x4(1)); }),
        use("Scene::setParent(Node, Node, Reparent)", [](Scene& s, Node bad) { s.setParent(bad, {}); }),
        { "Scene::setParent(Node, Node, Reparent)", "node", "",
          [](World& world, Handles const& bad) { world.scene.setParent(world.all.node, bad.node); }, true },
        use("Scene::setLightChannels(Node, LightChannels)", [](Scene& s, Node bad) { s.setLightChannels(bad, 1); }),
        use("Scene::setVisible(Node, bool)", [](Scene& s, Node bad) { s.setVisible(bad, true); }),
        use("Scene::setLayers(Node, Layers, Layers)", [](Scene& s, Node bad) { s.setLayers(bad, 1, 1); }),
        use("Scene::setDrawOrder(Node, DrawOrder)", [](Scene& s, Node bad) { s.setDrawOrder(bad, {}); }),
        use("Scene::setVariant(Node, string_view)", [](Scene& s, Node bad) { (void)s.setVariant(bad, "x"); }),
        use("Scene::parentFromNode(Node)", [](Scene& s, Node bad) { (void)s.parentFromNode(bad); }),
        use("Scene::worldFromNode(Node)", [](Scene& s, Node bad) { (void)s.worldFromNode(bad); }),
        use("Scene::name(Node)", [](Scene& s, Node bad) { (void)s.name(bad); }),
        use("Scene::parent(Node)", [](Scene& s, Node bad) { (void)s.parent(bad); }),
        use(
                "Scene::firstChild(Node)", [](Scene& s, Node bad) { (void)s.firstChild(bad); }, true),
        use("Scene::nextSibling(Node)", [](Scene& s, Node bad) { (void)s.nextSibling(bad); }),
        use(
                "Scene::findNode(string_view, Node)", [](Scene& s, Node bad) { (void)s.findNode("x", bad); }, true),
    };
}

class MisuseDeathTest : public testing::TestWithParam<std::vector<Use> (*)()> {
protected:
    void expectEnd(std::function<void(World&, Handles const&)> const& run, Handles const& bad,
                   std::string const& line) {
        EXPECT_DEATH(run(mWorld, bad), test::misuseLine(line));
    }
    World mWorld;
};

TEST_P(MisuseDeathTest, ByAHandleThatIsNull) {
    for (Use const& use : GetParam()()) {
        if (use.acceptsNull) {
            use.run(mWorld, {});
            continue;
        }
        const bool isOfScene = use.name[0] == '\0';
        const std::string why = isOfScene ? "none was added or found"
                                          : "none was created, or Engine::takeErrors() says why creating it failed";
        expectEnd(use.run, {}, fmt::format("{}: the {} is null: {}", use.call, use.kind, why));
    }
}

TEST_P(MisuseDeathTest, ByAHandleWhoseObjectIsGone) {
    const Handles dead = World::make(mWorld.engine, mWorld.scene);
    World::destroy(mWorld.engine, mWorld.scene, dead);
    for (Use const& use : GetParam()()) {
        const bool isOfScene = use.name[0] == '\0';
        const std::string what = isOfScene ? fmt::format("the {} was removed from the scene", use.kind)
                                           : fmt::format("the {} '{}' was destroyed", use.kind, use.name);
        expectEnd(use.run, dead, fmt::format("{}: {}", use.call, what));
    }
}

TEST_P(MisuseDeathTest, ByAHandleWhosePlaceAnotherObjectTook) {
    const Handles dead = World::make(mWorld.engine, mWorld.scene);
    World::destroy(mWorld.engine, mWorld.scene, dead);
    const Handles after = World::make(mWorld.engine, mWorld.scene);
    EXPECT_EQ(after.texture.index() | after.depth.index(), dead.texture.index() | dead.depth.index());
    for (Use const& use : GetParam()()) {
        const bool isOfScene = use.name[0] == '\0';
        const char* end = isOfScene ? "removed from the scene" : "destroyed";
        expectEnd(use.run, dead, fmt::format("{}: the {} was {}", use.call, use.kind, end));
    }
    World::destroy(mWorld.engine, mWorld.scene, after);
}

TEST_P(MisuseDeathTest, ByAHandleOfAnother) {
    const World other;
    for (Use const& use : GetParam()()) {
        const char* owner = use.name[0] == '\0' ? "scene" : "engine";
        expectEnd(use.run, other.all, fmt::format("{}: the {} belongs to another {}", use.call, use.kind, owner));
    }
}

INSTANTIATE_TEST_SUITE_P(Uses, MisuseDeathTest,
                         testing::Values(usesOfTextures, usesOfGeometry, usesOfMaterials, usesOfInstances, usesOfLight,
                                         usesOfTargets, usesOfRenderables, usesOfLampsAndSkins, usesOfNodes));

// ---- scenes, models and environments of another engine; what was moved from

TEST(MisuseOfOwnersDeathTest, ASceneIsDrawnByRenderersOfItsEngine) {
    World world, other;
    Renderer renderer(world.engine);
    const View view{ .size = { 4, 4 } };
    const auto line = [](const char* call) {
        return test::misuseLine(fmt::format("{}: the scene belongs to another engine", call));
    };
    EXPECT_DEATH(renderer.render(other.scene, view, world.all.chain), line("Renderer::render(Scene, View, SwapChain)"));
    EXPECT_DEATH(renderer.render(other.scene, view, world.all.target),
                 line("Renderer::render(Scene, View, RenderTarget)"));
    EXPECT_DEATH(renderer.prewarm(other.scene, view, world.all.chain),
                 line("Renderer::prewarm(Scene, View, SwapChain)"));
    EXPECT_DEATH(renderer.prewarm(other.scene, view, world.all.target),
                 line("Renderer::prewarm(Scene, View, RenderTarget)"));
    EXPECT_DEATH(renderer.render(other.scene, MeshPass{}, world.all.target),
                 line("Renderer::render(Scene, MeshPass, RenderTarget, View)"));
    EXPECT_DEATH(renderer.prewarm(other.scene, MeshPass{}, world.all.target),
                 line("Renderer::prewarm(Scene, MeshPass, RenderTarget, View)"));
    EXPECT_DEATH(renderer.pick(other.scene, view, {}), line("Renderer::pick(Scene, View, uint2, PickAim)"));
    EXPECT_DEATH((void)renderer.renderToImage(other.scene, view), line("Renderer::renderToImage(Scene, View)"));
}

TEST(MisuseOfOwnersDeathTest, WhatWasMovedFromIsNotUsed) {
    World world;
    const auto line = [](const char* call) {
        return test::misuseLine(fmt::format("{}: the object was moved from; use the one that it was moved to", call));
    };
    Scene scene(world.engine);
    const Scene taken(std::move(scene));
    EXPECT_DEATH((void)scene.bounds(), line("Scene::bounds()"));
    Renderer renderer(world.engine);
    const Renderer other(std::move(renderer));
    EXPECT_DEATH((void)renderer.statistics(), line("Renderer::statistics()"));
    Engine engine = std::move(*Engine::create({ .backend = Backend::Null, .workers = 0 }));
    const Engine moved(std::move(engine));
    EXPECT_DEATH((void)engine.device(), line("Engine::device()"));
    LoadTicket<Model> ticket = loadGltfAsync(world.engine, "house.gltf");
    const LoadTicket<Model> given(std::move(ticket));
    EXPECT_DEATH((void)ticket.poll(), test::misuseLine("LoadTicket::poll(size_t): the ticket was moved from; use the "
                                                       "one that it was moved to"));
}

// ---- bounds

TEST(MisuseOfBoundsDeathTest, NoAxisIsTurnedRoundAlone) {
    World world;
    Handles& all = world.all;
    const double kNan = std::numeric_limits<double>::quiet_NaN();
    const auto line = [](const char* call) {
        return test::misuseLine(
                fmt::format("{}: the minimum of the bounds is above their maximum, or no number", call));
    };
    for (const double3 low : { double3(2, 0, 0), double3(0, 2, 0), double3(0, 0, 2), double3(0, kNan, 0) }) {
        EXPECT_DEATH(world.scene.setBounds(all.renderable, { low, double3(1) }),
                     line("Scene::setBounds(Renderable, Box)"));
        const GeometryDesc geometry{ .vertices = all.vertices,
                                     .indices = all.indices,
                                     .bounds = Box{ low, double3(1) } };
        EXPECT_DEATH(world.scene.setGeometry(all.renderable, geometry),
                     line("Scene::setGeometry(Renderable, GeometryDesc)"));
    }
    EXPECT_DEATH(world.scene.setBounds(all.renderable, {}), line("Scene::setBounds(Renderable, Box)"));
    world.scene.setBounds(all.renderable, { double3(1), double3(1) }); // a point
}

// ---- threads

template <class F>
void onAnotherThread(F&& run) {
    std::thread(std::forward<F>(run)).join();
}

TEST(MisuseOfThreadsDeathTest, AnEngineAndAllThatBelongsToItStayOnItsThread) {
    World world;
    const auto line = [](const char* call) {
        return test::misuseLine(
                fmt::format("{}: called on another thread than the engine's, which is the one that created it, or "
                            "that called Engine::useOnThisThread() last",
                            call));
    };
    EXPECT_DEATH(onAnotherThread([&] { (void)world.engine.create(TextureDesc{}); }),
                 line("Engine::create(TextureDesc)"));
    EXPECT_DEATH(onAnotherThread([&] { world.engine.destroy(world.all.texture); }),
                 line("Engine::destroy(EngineObject)"));
    EXPECT_DEATH(onAnotherThread([&] { world.scene.remove(world.all.node); }), line("Scene::remove(Node)"));
    EXPECT_DEATH(onAnotherThread([&] { (void)ModelCopy::of(world.scene, world.all.node); }),
                 line("ModelCopy::of(Scene, Node)"));
    EXPECT_DEATH(onAnotherThread([&] { (void)createBuiltInMaterial(world.engine, "lit"); }),
                 line("createBuiltInMaterial(Engine, string_view) of 'lit'"));
    EXPECT_DEATH(onAnotherThread([&] { (void)loadGltfAsync(world.engine, "house.gltf"); }),
                 line("loadGltfAsync(Engine, path) of 'house.gltf'"));
    EXPECT_DEATH(onAnotherThread([&] { (void)loadGltfAsync(world.engine, GltfMemory{ .name = "house" }); }),
                 line("loadGltfAsync(Engine, GltfMemory) of 'house'"));
    EXPECT_DEATH(onAnotherThread([&] { (void)loadEnvironmentAsync(world.engine, "sky.hdr"); }),
                 line("loadEnvironmentAsync(Engine, path) of 'sky.hdr'"));
    EXPECT_DEATH(onAnotherThread([&] { (void)loadEnvironmentAsync(world.engine, {}, "sky"); }),
                 line("loadEnvironmentAsync(Engine, span<byte>, string_view) of 'sky'"));
    Renderer renderer(world.engine);
    EXPECT_DEATH(onAnotherThread([&] {
                     renderer.render(world.scene, { .size = { 4, 4 } }, world.all.chain);
                 }),
                 line("Renderer::render(Scene, View, SwapChain)"));
    EXPECT_DEATH(onAnotherThread([&] { const Scene scene(std::move(world.scene)); }), line("Scene::~Scene()"));
    EXPECT_DEATH(onAnotherThread([&] { const Engine engine(std::move(world.engine)); }), line("Engine::~Engine()"));
}

TEST(MisuseOfThreadsDeathTest, TicketsFollowTheirEngine) {
    World world;
    std::optional<LoadTicket<Model>> ticket = loadGltfAsync(world.engine, "house.gltf");
    const auto line = [](const char* call) {
        return test::misuseLine(
                fmt::format("{}: called on another thread than the engine's, which is the one that created it, or "
                            "that called Engine::useOnThisThread() last",
                            call));
    };
    EXPECT_DEATH(onAnotherThread([&] { ticket->poll(); }), line("LoadTicket::poll(size_t)"));
    EXPECT_DEATH(onAnotherThread([&] { (void)ticket->status(); }), line("LoadTicket::status()"));
    EXPECT_DEATH(onAnotherThread([&] { ticket->cancel(); }), line("LoadTicket::cancel()"));
    EXPECT_DEATH(onAnotherThread([&] { (void)ticket->take(); }), line("LoadTicket::take()"));
    EXPECT_DEATH(onAnotherThread([&] { (void)ticket->wait(); }), line("LoadTicket::wait()"));
    EXPECT_DEATH(onAnotherThread([&] { ticket.reset(); }), line("LoadTicket::~LoadTicket()"));
    onAnotherThread([&] {
        world.engine.useOnThisThread();
        EXPECT_EQ(ticket->wait().error().code, ErrorCode::NotFound);
        ticket.reset();
    });
    world.engine.useOnThisThread();
}

TEST(MisuseOfThreadsDeathTest, AnEngineMovesToTheThreadThatTakesIt) {
    World world;
    onAnotherThread([&] {
        world.engine.useOnThisThread();
        world.scene.setTransform(world.all.node, double4x4(1));
    });
    EXPECT_DEATH(world.scene.setTransform(world.all.node, double4x4(1)), "called on another thread than the engine's");
    world.engine.useOnThisThread();
    world.scene.setTransform(world.all.node, double4x4(1));
}

// ---- what outlives its engine

TEST(MisuseOfEnginesDeathTest, WhatOutlivesItsEngineEndsInPeaceButIsNotUsed) {
    std::optional<Engine> engine = std::move(*Engine::create({ .backend = Backend::Null, .workers = 0 }));
    Scene scene(*engine);
    Renderer renderer(*engine);
    const Owned<Texture> texture = engine->own(engine->create(TextureDesc{}));
    const Owned<SwapChain> chain = engine->own(engine->create(SwapChainDesc{ .size = { 4, 4 } }));
    renderer.render(scene, { .size = { 4, 4 } }, chain);
    (void)renderer.renderToImage(scene, { .size = { 4, 4 } });
    engine.reset();
    const auto line = [](const char* call) {
        return test::misuseLine(fmt::format("{}: its engine is gone; destroy engines last", call));
    };
    EXPECT_DEATH((void)scene.add(NodeDesc{}), line("Scene::add(NodeDesc)"));
    EXPECT_DEATH((void)renderer.takeTimings(), line("Renderer::takeTimings()"));
}

// ---- vertices that lack what a material reads

TEST(MisuseOfVerticesDeathTest, MaterialsAndWhatTheyReadFitTogether) {
    World world;
    const Owned<Material> lit = test::loadMaterial(world.engine, R"(material { name : chalk, shadingModel : lit,
        requires : [ uv1, color ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor = getColor() + getUV1().xyxy; } })");
    const Owned<MaterialInstance> chalk = world.engine.own(world.engine.createInstance(lit, "white"));
    const auto line = [](const char* call) {
        return test::misuseLine(
                fmt::format("{}: the vertex buffer lacks what material 'chalk' reads: Tangents, Color, Uv1", call));
    };
    EXPECT_DEATH(world.scene.add(with(world, [&](RenderableDesc& desc) { desc.material = chalk; })),
                 line("Scene::add(RenderableDesc) of 'ball'"));
    EXPECT_DEATH(world.scene.setMaterial(world.all.renderable, chalk),
                 line("Scene::setMaterial(Renderable, MaterialInstance)"));
}

TEST(MisuseOfParametersDeathTest, AnIdBelongsToOneMaterial) {
    World world;
    const Owned<Material> other = test::loadMaterial(world.engine, R"(material { name : other, shadingModel : unlit,
        parameters : [ { type : float4, name : tint } ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor = materialParams.tint; } })");
    const ParameterId tint = *world.engine.findParameter(other, "tint");
    for (const ParameterId wrong : { tint, ParameterId{} })
        EXPECT_DEATH((void)world.engine.set(world.all.instance, wrong, ParameterValue(float4(1))),
                     "a ParameterId belongs to the material of the instance");
}

TEST(Misuse, DestroyingNothingDoesNothing) {
    World world;
    world.engine.destroy(Texture{}), world.engine.destroy(VertexBuffer{}), world.engine.destroy(IndexBuffer{});
    world.engine.destroy(MorphTargets{}), world.engine.destroy(Material{}), world.engine.destroy(MaterialInstance{});
    world.engine.destroy(IndirectLight{}), world.engine.destroy(Skybox{}), world.engine.destroy(LightProfile{});
    world.engine.destroy(LightImage{}), world.engine.destroy(RenderTarget{}), world.engine.destroy(SwapChain{});
    EXPECT_THAT(world.engine.takeErrors(), testing::IsEmpty());
}

} // namespace
} // namespace filament_core
