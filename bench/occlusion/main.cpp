// SPDX-License-Identifier: Apache-2.0
// occlusion_bench: frames with and without View::occlusionCulling, and with levels of detail besides (View::lod), in
// turns, on both APIs:
//   city    10 000 buildings on a grid, seen from a street: boxes, with towers and lamps.
//   rooms   20 x 20 rooms with doors and furniture, seen from one of them.
//   field   the city from above, where nearly nothing is hidden: what looking for it costs.
//   sun     the city under a sun that moves in every frame, so that its shadow map is drawn in each.
//   lamps   the rooms with nine lamps that move in every frame: 54 maps of cube faces.
//   copies  a grid of copies of --model, seen from between them.
// Images with and without culling are compared as well: they have the same bits.
//   Status  0: measured, table on standard output; 1: the reason in one line, or images that differ.
#include "base/Assert.h"
#include "bench/ChoicesInTurns.h"
#include "toolkit/program/CommandLine.h"

#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <random>
#include <variant>

namespace filament_core::bench {
namespace {

struct Options {
    int rounds = 7, frames = 2;
    uint2 size{ 1280, 720 };
    std::vector<std::string> scenes{ "city", "rooms", "field", "sun", "lamps" };
    std::string model; ///< of `copies`
    int side = 10;     ///< copies
};

struct Choice {
    const char* name;
    bool culls;
    float lodPixels;
};
constexpr std::array kChoices{ Choice{ "without", false, 0 }, Choice{ "culled", true, 0 },
                               Choice{ "culled, lod.pixels=1", true, 1 } };

enum Shape : size_t { kBox, kTorus, kCylinder, kShapes };

/// A mesh and coarser ones behind it, in the same buffers.
struct LeveledMesh {
    Mesh mesh;
    uint32_t finestIndices = 0;
    std::vector<GeometryLevel> levels;

    void addLevel(Mesh const& coarser, float errorMeters) {
        const auto first = static_cast<uint32_t>(mesh.vertices.size());
        levels.push_back({ .firstIndex = static_cast<uint32_t>(mesh.indices.size()),
                           .indexCount = static_cast<uint32_t>(coarser.indices.size()),
                           .errorMeters = errorMeters,
                           .occluder = coarser.occluder() });
        mesh.vertices.insert(mesh.vertices.end(), coarser.vertices.begin(), coarser.vertices.end());
        for (const uint32_t index : coarser.indices) mesh.indices.push_back(first + index);
    }
};

/// How far a polygon of `corners` is inside its circle.
float sagitta(float radius, uint32_t corners) {
    return radius * (1 - std::cos(3.14159265f / static_cast<float>(corners)));
}

LeveledMesh makeShape(Shape shape) {
    if (shape == kBox) return { .mesh = makeBox().value(), .finestIndices = 36 };
    LeveledMesh made;
    for (const uint32_t slices : { 32u, 16u, 8u }) {
        const TorusShape torus{ .slices = slices, .stacks = slices / 2 };
        const Mesh mesh = (shape == kTorus ? makeTorus(torus) : makeCylinder({ .slices = slices })).value();
        if (made.mesh.vertices.empty()) {
            made = { .mesh = mesh, .finestIndices = static_cast<uint32_t>(mesh.indices.size()) };
            continue;
        }
        const float error = shape == kTorus ? sagitta(torus.radius + torus.tubeRadius, slices) +
                                                      sagitta(torus.tubeRadius, slices / 2)
                                            : sagitta(0.5f, slices);
        made.addLevel(mesh, error);
    }
    return made;
}

class Device {
public:
    Device(Engine engine, Options const& options) : mOptions(options), mEngine(std::move(engine)), mRenderer(mEngine) {
        mMaterial = mEngine.own(createBuiltInMaterial(mEngine, "lit").value());
        for (const float3 color : { float3(0.7f, 0.65f, 0.6f), float3(0.5f, 0.3f, 0.25f), float3(0.3f, 0.35f, 0.4f) }) {
            mPaints.push_back(mEngine.own(mEngine.createInstance(mMaterial)));
            const Result<void> set = mEngine.set(mPaints.back(), "baseColor", color);
            FILAMENT_ASSERT(set, "the built-in material has a base colour");
        }
        for (const Shape shape : { kBox, kTorus, kCylinder }) {
            LeveledMesh made = makeShape(shape);
            mVertices.push_back(mEngine.own(mEngine.create(made.mesh.vertexBuffer())));
            mIndices.push_back(mEngine.own(mEngine.create(made.mesh.indexBuffer())));
            Mesh finest = std::move(made.mesh);
            finest.indices.resize(made.finestIndices);
            mShapes.push_back({ .vertices = mVertices.back(),
                                .indices = mIndices.back(),
                                .indexCount = made.finestIndices,
                                .bounds = finest.bounds(),
                                .occluder = finest.occluder(),
                                .levels = std::move(made.levels) });
        }
        mView.size = options.size;
        mTarget = mEngine.own(mEngine.create(SwapChainDesc{ .size = mView.size, .name = "occlusion_bench" }));
    }

    /// Takes the place of the scene before.
    Result<void> show(std::string const& name) {
        mMoving.clear();
        mScene = std::make_unique<Scene>(mEngine);
        std::mt19937 random(1);
        mView.quality.shadows = name == "sun" || name == "lamps" ? ShadowFilter::Pcf3 : ShadowFilter::Off;
        if (name == "copies") return addCopies();
        const bool isInside = name == "rooms" || name == "lamps";
        if (isInside)
            addRooms(random);
        else
            addCity(random);
        const float3 down{ -0.4f, -1, -0.3f };
        if (name == "lamps")
            addLamps();
        else
            addSun(down, name == "sun");
        const Lens lens{ .verticalFovDegrees = 60 };
        mView.camera = isInside          ? Camera::lookAt({ 60.5, 1.6, -1 }, { 58, 1.4, -20 }, lens)
                       : name == "field" ? Camera::lookAt({ 0, 700, 300 }, { 0, 0, -800 }, lens)
                                         : Camera::lookAt({ 0.5, 1.7, 15 }, { 3, 6, -100 }, lens);
        return {};
    }

    /// Milliseconds per frame.
    double measure(Choice const& choice) {
        choose(choice);
        mRenderer.render(*mScene, mView, mTarget);
        mEngine.waitIdle();
        return millisecondsPerFrame(mEngine, mOptions.frames, [&] {
            move();
            mRenderer.render(*mScene, mView, mTarget);
        });
    }

    Result<bool> hasSameBits() {
        std::array<Image, 2> images;
        for (size_t i = 0; i < 2; ++i) {
            choose(kChoices[i]);
            Renderer renderer(mEngine); // which draws all shadow maps
            Result<Image> image = renderer.renderToImage(*mScene, mView);
            if (!image) return image.error();
            images[i] = std::move(*image);
        }
        return images[0].pixels == images[1].pixels;
    }

    FrameStatistics statistics() const { return mRenderer.statistics(); }
    const char* name() const { return toString(mEngine.device().backend); }

private:
    struct Moving {
        Light light{};
        LightDesc desc;
    };

    void choose(Choice const& choice) {
        mView.occlusionCulling = choice.culls;
        mView.lod.pixels = choice.lodPixels;
    }

    /// By less than can be seen, and enough to draw its shadow maps again.
    void move() {
        mStep = mStep > 0 ? -1e-4f : 1e-4f;
        for (Moving& moving : mMoving) {
            if (SunLight* sun = std::get_if<SunLight>(&moving.desc))
                sun->directionWorld.x += mStep;
            else
                std::get<PointLight>(moving.desc).positionWorld.x += static_cast<double>(mStep);
            mScene->set(moving.light, moving.desc);
        }
    }

    void addSun(float3 direction, bool moves) {
        const SunLight sun{ .directionWorld = direction };
        const Light light = mScene->add(sun);
        if (moves) mMoving.push_back({ light, sun });
    }

    /// In the room of the camera and those around it.
    void addLamps() {
        for (int x = 9; x <= 11; ++x) {
            for (int z = 0; z < 3; ++z) {
                const PointLight lamp{ .positionWorld = { 6.0 * x + 0.3, 2.5, -6.0 * z - 0.2 },
                                       .intensity = 2e4f,
                                       .rangeMeters = 15 };
                const Light light = mScene->add(lamp);
                mMoving.push_back({ light, lamp });
            }
        }
    }

    /// As near to each other as they fit, each 10 m wide.
    Result<void> addCopies() {
        if (!mModel) {
            Result<Model> model = loadGltf(mEngine, mOptions.model, { .simplified = true });
            if (!model) return model.error();
            mModel.emplace(std::move(*model));
        }
        const Box bounds = mModel->bounds();
        const double3 size = bounds.max - bounds.min;
        const double scale = 10 / std::max(size.x, size.z);
        const double3 middle = (bounds.min + bounds.max) * 0.5;
        for (int x = 0; x < mOptions.side; ++x) {
            for (int z = 0; z < mOptions.side; ++z) {
                const double3 at((x - 0.5 * (mOptions.side - 1)) * scale * size.x, 0, -z * scale * size.z);
                mScene->add(*mModel, glm::translate(glm::scale(glm::translate(double4x4(1), at), double3(scale)),
                                                    -double3(middle.x, bounds.min.y, middle.z)));
            }
        }
        addSun({ -0.4f, -1, -0.3f }, false);
        const double eye = 0.35 * scale * size.y;
        mView.camera =
                Camera::lookAt({ 0, eye, 0.8 * scale * size.z }, { 0, 0.9 * eye, -10 }, { .verticalFovDegrees = 60 });
        return {};
    }

    void add(Shape shape, double3 at, double3 scale, size_t paint) {
        RenderableDesc desc = mShapes[shape];
        desc.material = mPaints[paint % mPaints.size()];
        desc.worldFromObject = glm::scale(glm::translate(double4x4(1), at), scale);
        mScene->add(desc);
    }

    /// Blocks of 20 m, with towers and water tanks on their roofs.
    void addCity(std::mt19937& random) {
        const auto next = [&] { return static_cast<double>(random()) / 4294967296.0; };
        for (int x = 0; x < 100; ++x) {
            for (int z = 0; z < 100; ++z) {
                const double height = 12 + 40 * next() * next(), middle = 20 * (x - 49.5);
                add(kBox, { middle, height / 2, -20.0 * z }, { 13, height, 14 }, random());
                add(kTorus, { middle, height + 1, -20.0 * z }, double3(3), random());
                for (int lamp = 0; lamp < 2; ++lamp)
                    add(kCylinder, { middle + 8, 2, -20.0 * z + 6 * lamp }, { 0.2, 4, 0.2 }, random());
            }
        }
        add(kBox, { 0, -0.5, -1000 }, { 3000, 1, 3000 }, 2);
    }

    /// Rooms of 6 x 6 x 3 m; walls leave a door in the middle.
    void addRooms(std::mt19937& random) {
        const auto next = [&] { return static_cast<double>(random()) / 4294967296.0; };
        for (int x = 0; x < 20; ++x) {
            for (int z = 0; z < 20; ++z) {
                const double3 at(6.0 * x, 0, -6.0 * z);
                for (const double side : { -1.8, 1.8 }) {
                    add(kBox, at + double3(side, 1.5, -3), { 2.4, 3, 0.2 }, 0);
                    add(kBox, at + double3(3, 1.5, side), { 0.2, 3, 2.4 }, 0);
                }
                add(kBox, at + double3(0, -0.05, 0), { 6, 0.1, 6 }, 1);
                add(kBox, at + double3(0, 3.05, 0), { 6, 0.1, 6 }, 0);
                for (int i = 0; i < 12; ++i)
                    add(i % 2 ? kTorus : kCylinder, at + double3(4 * next() - 2, 0.5, 4 * next() - 2),
                        double3(0.3 + 0.4 * next()), random());
            }
        }
    }

    Options const& mOptions;
    Engine mEngine;
    Owned<Material> mMaterial;
    std::vector<Owned<MaterialInstance>> mPaints;
    std::vector<Owned<VertexBuffer>> mVertices;
    std::vector<Owned<IndexBuffer>> mIndices;
    std::vector<RenderableDesc> mShapes;
    std::optional<Model> mModel;
    std::unique_ptr<Scene> mScene; // destroyed before the objects that it shows
    std::vector<Moving> mMoving;
    float mStep = 0;
    Owned<SwapChain> mTarget;
    Renderer mRenderer;
    View mView;
};

Result<void> measureOn(Backend backend, Options const& options) {
    Result<Engine> engine = Engine::create({ .backend = backend });
    if (!engine) return engine.error();
    Device device(std::move(*engine), options);
    for (std::string const& scene : options.scenes) {
        if (Result<void> shown = device.show(scene); !shown) return shown;
        std::array<FrameStatistics, kChoices.size()> drawn;
        const ChoicesInTurns<kChoices.size()> turns(options.rounds, [&](size_t i) {
            const double milliseconds = device.measure(kChoices[i]);
            drawn[i] = device.statistics();
            return std::array{ milliseconds };
        });
        for (size_t i = 0; i < kChoices.size(); ++i)
            std::printf("| %s | %s | %s | %u | %u | %.1f | %.2f |\n", scene.c_str(), device.name(), kChoices[i].name,
                        drawn[i].visible, drawn[i].triangles, turns.least(i), turns.ratio(i));
        std::fflush(stdout);
        const Result<bool> same = device.hasSameBits();
        if (!same) return same.error();
        if (!*same) return fail(ErrorCode::Internal, "scene '{}': the images with and without culling differ", scene);
    }
    return {};
}

Result<void> run(Options const& options) {
    std::printf("| scene | API | choice | objects drawn | triangles of all views | ms | ratio |\n"
                "|---|---|---|---|---|---|---|\n");
    for (const Backend backend : { Backend::Vulkan, Backend::Gles })
        if (Result<void> done = measureOn(backend, options); !done) return done;
    return {};
}

} // namespace
} // namespace filament_core::bench

int main(int argc, char** argv) {
    using namespace filament_core;
    bench::Options options;
    tools::CommandLine app{ "Frames with and without occlusion culling and levels of detail." };
    app.option("--rounds", options.rounds, "rounds; each draws both").inRange(1, 1000);
    app.option("--frames", options.frames, "frames a measurement").inRange(1, 1000);
    app.option("--scenes", options.scenes, "which scenes")
            .oneOf({ "city", "rooms", "field", "sun", "lamps", "copies" });
    app.option("--model", options.model, "glTF file of the scene `copies`");
    app.option("--side", options.side, "copies in each direction").inRange(1, 100);
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    const Result<void> done = bench::run(options);
    if (!done) std::fprintf(stderr, "occlusion_bench: error: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
