// SPDX-License-Identifier: Apache-2.0
// Several views of one engine that take turns: none slows the others down, and each keeps its image.
#include "backend/layers/Traced.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <gmock/gmock.h>

#include <unistd.h>

namespace filament_core {
namespace {

constexpr const char* kPhoto = R"(material { name : photo, shadingModel : unlit, requires : [ uv0 ],
    parameters : [ { type : sampler2d, name : picture }, { type : float, name : gain } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = texture(materialParams_picture, getUV0()) * materialParams.gain;
} })";

constexpr const char* kPaint = R"(material { name : paint, shadingModel : unlit }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = vec4(0.5); } })";

/// A checkered square and a plain one, and a view for each filter.
struct TwoSquares {
    explicit TwoSquares(Engine& owner) : engine(owner), square(owner), scene(owner) {
        std::array<uint8_t, 4 * 4 * 4> texels{};
        for (size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<uint8_t>((i / 4 + i / 16) % 2 ? 255 : i);
        picture = engine.own(engine.create(TextureDesc{
                .format = Format::RGBA8, .width = 4, .height = 4, .pixels = std::as_bytes(std::span(texels)) }));
        photo = loadInstance(kPhoto, photoMaterial);
        paint = loadInstance(kPaint, paintMaterial);
        EXPECT_TRUE(engine.set(photo, "gain", 1.0f).ok());
        EXPECT_TRUE(engine.set(photo, "picture", picture, kUnfilteredSampler).ok());
        square.add(scene, photo, { 0, 0, -0.5 });
        square.add(scene, paint, { 0.7, 0.7, 0 }, 0.3);
        view = test::SquareMesh::view();
    }

    View viewWith(TextureFilter filter) const {
        View with = view;
        with.quality.textureFilter = filter;
        return with;
    }

    Owned<MaterialInstance> loadInstance(const char* text, Owned<Material>& material) {
        material = test::loadMaterial(engine, text);
        return engine.own(engine.createInstance(material));
    }

    Engine& engine;
    test::SquareMesh square;
    Scene scene;
    Owned<Texture> picture;
    Owned<Material> photoMaterial, paintMaterial;
    Owned<MaterialInstance> photo, paint;
    View view;
};

/// Counts the objects that a stream creates and destroys.
struct Creations {
    uint32_t bindGroups = 0, others = 0, ended = 0;
    void execute(backend::CmdCreateBindGroup const&) { ++bindGroups; }
    void execute(backend::CmdCreateBuffer const&) { ++others; }
    void execute(backend::CmdCreateTexture const&) { ++others; }
    void execute(backend::CmdCreateSampler const&) { ++others; }
    void execute(backend::CmdCreateProgram const&) { ++others; }
    void execute(backend::CmdCreatePipeline const&) { ++others; }
    void execute(backend::CmdDestroyBindGroup const&) { ++ended; }
    void execute(backend::CmdDestroyBuffer const&) { ++ended; }
    void execute(auto const&) {}
};

constexpr std::array kFilters{ TextureFilter::AsAuthored, TextureFilter::Trilinear, TextureFilter::Anisotropic };

class TracedEngine {
public:
    explicit TracedEngine(const char* name)
            : path(std::filesystem::temp_directory_path() / (name + std::to_string(::getpid()))),
              engine(std::move(*Engine::create(
                      { .backend = Backend::Null, .workers = 0, .validation = true, .traceFile = path }))) {}
    ~TracedEngine() {
        std::filesystem::remove(path);
        std::filesystem::remove(path.string() + ".bin");
    }

    /// The total over all submissions so far.
    std::vector<Creations> creations() {
        engine.waitIdle();
        std::vector<Creations> all;
        const auto streams = backend::loadTrace(path);
        EXPECT_TRUE(streams.ok());
        for (backend::CommandBuffer const& stream : *streams) replay(stream.view(), all.emplace_back());
        return all;
    }

    std::filesystem::path path;
    Engine engine;
};

TEST(SeveralViews, WithDifferentFiltersTakeTurnsWithoutMakingAnything) {
    TracedEngine traced("several-views");
    TwoSquares stage(traced.engine);
    Renderer renderer(traced.engine);
    const Owned<SwapChain> target = traced.engine.own(traced.engine.create(SwapChainDesc{ .size = stage.view.size }));
    const auto draw = [&](size_t frames) {
        for (size_t i = 0; i < frames; ++i)
            renderer.render(stage.scene, stage.viewWith(kFilters[i % kFilters.size()]), target);
    };
    draw(9); // FrameData has three sets
    const size_t before = traced.creations().size();
    draw(30);
    const std::vector<Creations> streams = traced.creations();
    ASSERT_GE(streams.size(), before + 30);
    for (size_t i = before; i < streams.size(); ++i) {
        EXPECT_EQ(streams[i].bindGroups, 0u) << "submission " << i;
        EXPECT_EQ(streams[i].others + streams[i].ended, 0u) << "submission " << i;
    }
    EXPECT_THAT(traced.engine.takeErrors(), testing::IsEmpty());
}

TEST(SeveralViews, AChangedTextureIsBoundAnewForEveryFilterInUseAndNoOther) {
    TracedEngine traced("several-views-changed");
    TwoSquares stage(traced.engine);
    Renderer renderer(traced.engine);
    const Owned<SwapChain> target = traced.engine.own(traced.engine.create(SwapChainDesc{ .size = stage.view.size }));
    size_t counted = 0; // waiting for submissions delivers the uploads made before the frame
    const auto drawAndCount = [&](TextureFilter filter) {
        renderer.render(stage.scene, stage.viewWith(filter), target);
        const std::vector<Creations> streams = traced.creations();
        Creations sum;
        for (; counted < streams.size(); ++counted) {
            sum.bindGroups += streams[counted].bindGroups;
            sum.ended += streams[counted].ended;
        }
        return sum;
    };
    for (int i = 0; i < 4; ++i) drawAndCount(TextureFilter::AsAuthored);
    EXPECT_EQ(drawAndCount(TextureFilter::Trilinear).bindGroups, 1u) << "the photo's; the paint has no textures";
    ASSERT_TRUE(stage.engine
                        .set(stage.photo, "picture", stage.picture,
                             Sampler{ Filter::Linear, Filter::Nearest, MipFilter::None, WrapMode::ClampToEdge,
                                      WrapMode::ClampToEdge })
                        .ok());
    const Creations changed = drawAndCount(TextureFilter::AsAuthored);
    EXPECT_EQ(changed.bindGroups, 2u);
    EXPECT_EQ(changed.ended, 2u);
    ASSERT_TRUE(stage.engine.set(stage.photo, "gain", 0.5f).ok());
    EXPECT_EQ(drawAndCount(TextureFilter::Trilinear).bindGroups, 0u) << "a number is no reason";
    EXPECT_THAT(traced.engine.takeErrors(), testing::IsEmpty());
}

class SeveralViewsOnADevice : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(BothApis, SeveralViewsOnADevice, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(SeveralViewsOnADevice, EachHasThePictureThatItHasAlone) {
    std::vector<std::vector<std::byte>> alone;
    for (const TextureFilter filter : kFilters) {
        auto engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
        TwoSquares stage(*engine);
        alone.push_back(test::renderLinear(*engine, stage.scene, stage.viewWith(filter)).pixels);
    }
    EXPECT_NE(alone[0], alone[1]) << "the filter shows";
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    TwoSquares stage(*engine);
    for (size_t frame = 0; frame < 9; ++frame) {
        const size_t i = frame * 2 % kFilters.size();
        EXPECT_EQ(test::renderLinear(*engine, stage.scene, stage.viewWith(kFilters[i])).pixels, alone[i]) << frame;
    }
    test::expectNoErrors(*engine);
}

} // namespace
} // namespace filament_core
