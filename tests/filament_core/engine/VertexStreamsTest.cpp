// SPDX-License-Identifier: Apache-2.0
// Meshes whose attributes lie in several vertex streams: the bits of interleaved ones, on both APIs, also after changes
// of one stream alone.
#include "tests/filament_core/engine/MisuseLine.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <cmath>

namespace filament_core {
namespace {

/// What MeshVertex interleaves, apart.
struct Streams {
    explicit Streams(Mesh const& mesh) {
        for (MeshVertex const& vertex : mesh.vertices) {
            positions.push_back(vertex.position);
            surfaces.push_back({ vertex.tangents, vertex.uv });
            colors.push_back(vertex.color);
        }
    }

    struct Surface {
        float4 tangents;
        float2 uv;
    };
    std::vector<float3> positions;
    std::vector<Surface> surfaces;
    std::vector<float4> colors;

    VertexStreamDesc surfaceStream() const {
        return { .stride = sizeof(Surface),
                 .attributes = { { Attribute::Tangents, VertexFormat::Float4, offsetof(Surface, tangents) },
                                 { Attribute::Uv0, VertexFormat::Float2, offsetof(Surface, uv) } },
                 .data = std::as_bytes(std::span(surfaces)) };
    }
    VertexStreamDesc colorStream() const {
        return { .stride = sizeof(float4),
                 .attributes = { { Attribute::Color, VertexFormat::Float4, 0 } },
                 .data = std::as_bytes(std::span(colors)) };
    }
    VertexStreamDesc positionStream() const {
        return { .stride = sizeof(float3),
                 .attributes = { { Attribute::Position, VertexFormat::Float3, 0 } },
                 .data = std::as_bytes(std::span(positions)) };
    }
    /// Positions in the first, or in the last.
    VertexBufferDesc desc(bool positionsFirst) const {
        const VertexStreamDesc first = positionsFirst ? positionStream() : colorStream();
        return { .vertexCount = static_cast<uint32_t>(positions.size()),
                 .stride = first.stride,
                 .attributes = first.attributes,
                 .data = first.data,
                 .streams = { surfaceStream(), positionsFirst ? colorStream() : positionStream() },
                 .name = "in streams" };
    }
};

enum class Layout : uint8_t { Interleaved, PositionsFirst, PositionsLast };

Mesh ball() { return *makeUvSphere({ .radius = 0.6f, .slices = 24, .stacks = 12 }); }

/// Bent, and of other colours.
Mesh changedBall() {
    Mesh mesh = ball();
    for (MeshVertex& vertex : mesh.vertices) {
        vertex.position.x += 0.3f * std::sin(4 * vertex.position.y);
        vertex.color = float4(vertex.uv.x, 0.5f, vertex.uv.y, 1);
    }
    return mesh;
}

/// A ball that casts shadows on a plate.
class StreamStage {
public:
    StreamStage(Backend backend, Layout layout)
            : mLayout(layout), engine(*test::makeEngine(backend)), scene(engine), renderer(engine) {
        mMaterial = engine.own(*createBuiltInMaterial(engine, "litVertexColors"));
        mInstance = engine.own(engine.createInstance(mMaterial));
        const Mesh mesh = ball(), plate = *makePlane({ .width = 4, .depth = 4 });
        vertices = engine.own(layout == Layout::Interleaved
                                      ? engine.create(mesh.vertexBuffer())
                                      : engine.create(Streams(mesh).desc(layout == Layout::PositionsFirst)));
        mIndices = engine.own(engine.create(mesh.indexBuffer()));
        mPlateVertices = engine.own(engine.create(plate.vertexBuffer()));
        mPlateIndices = engine.own(engine.create(plate.indexBuffer()));
        scene.add({ .vertices = mPlateVertices, .indices = mPlateIndices, .material = mInstance });
        const double4x4 up(double4(1, 0, 0, 0), double4(0, 1, 0, 0), double4(0, 0, 1, 0), double4(0, 0.8, 0, 1));
        copies.push_back(
                scene.add({ .vertices = vertices, .indices = mIndices, .material = mInstance, .worldFromObject = up }));
        scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.3f }, .illuminance = Lux{ 60'000 } });
        view = { .camera = Camera::lookAt({ 0, 2.5, 4 }, { 0, 0.4, 0 }), .size = { 96, 72 } };
    }
    ~StreamStage() { test::expectNoErrors(engine); }

    /// Positions or colours, alone where they lie apart.
    void update(Mesh const& mesh, bool positions) {
        const Streams streams(mesh);
        if (mLayout == Layout::Interleaved) {
            engine.update(vertices, mesh.vertexBuffer().data);
            return;
        }
        const auto data =
                positions ? std::as_bytes(std::span(streams.positions)) : std::as_bytes(std::span(streams.colors));
        engine.update(vertices, data, 0, positions == (mLayout == Layout::PositionsFirst) ? 0 : 2);
    }
    Image draw() { return test::renderLinear(engine, renderer, scene, view); }

private:
    Layout mLayout;

public:
    Engine engine;
    Scene scene;
    Renderer renderer;
    View view;
    Owned<VertexBuffer> vertices;
    std::vector<Renderable> copies;

private:
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
    Owned<VertexBuffer> mPlateVertices;
    Owned<IndexBuffer> mIndices, mPlateIndices;
};

TEST(VertexStreams, HaveTheBitsOfInterleavedVerticesAlsoWhenOneIsChanged) {
    const Mesh before = ball(), after = changedBall();
    Mesh bent = before; // the positions alone
    for (size_t i = 0; i < bent.vertices.size(); ++i) bent.vertices[i].position = after.vertices[i].position;
    std::vector<std::vector<Image>> images;
    for (const Backend backend : test::kBothApis) {
        for (const Layout layout : { Layout::Interleaved, Layout::PositionsFirst, Layout::PositionsLast }) {
            StreamStage stage(backend, layout);
            std::vector<Image>& drawn = images.emplace_back();
            drawn.push_back(stage.draw());
            drawn.push_back(stage.draw()); // with a shadow map that is kept
            stage.update(bent, true);
            drawn.push_back(stage.draw());
            stage.update(after, false);
            drawn.push_back(stage.draw());
        }
    }
    for (std::vector<Image> const& drawn : images) {
        for (size_t i = 0; i < drawn.size(); ++i) EXPECT_EQ(drawn[i].pixels, images[0][i].pixels) << i;
    }
    EXPECT_GT(test::differenceOf(images[0][0], images[0][2]).pixels, 200u) << "the test sees positions";
    EXPECT_GT(test::differenceOf(images[0][2], images[0][3]).pixels, 200u) << "and colours";
}

TEST(VertexStreams, BoundsFollowTheStreamOfPositionsAlone) {
    for (const Layout layout : { Layout::PositionsFirst, Layout::PositionsLast }) {
        StreamStage stage(Backend::Null, layout);
        Mesh mesh = ball();
        const auto top = [&] { return stage.scene.bounds().max.y; };
        EXPECT_NEAR(top(), 1.4, 1e-6);
        for (MeshVertex& vertex : mesh.vertices) vertex.position *= 2.0f, vertex.color = float4(100);
        stage.update(mesh, false);
        stage.draw();
        EXPECT_NEAR(top(), 1.4, 1e-6) << "colours are no positions";
        stage.update(mesh, true);
        stage.draw();
        EXPECT_NEAR(top(), 2.0, 1e-6);
    }
}

TEST(VertexStreams, MistakesAreNamed) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const auto create = [](auto const& change) {
        auto engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
        const Streams streams(ball());
        VertexBufferDesc desc = streams.desc(true);
        change(desc);
        engine->create(desc);
    };
    const auto line = [](const char* what) {
        return test::misuseLine(std::string("Engine::create(VertexBufferDesc) of 'in streams': ") + what);
    };
    EXPECT_DEATH(create([](VertexBufferDesc& desc) { desc.streams[1].data = desc.streams[1].data.first(160); }),
                 line("stream 2 has 160 bytes, which is not 323 vertices of 16 bytes: streams have as many vertices as "
                      "the buffer"));
    EXPECT_DEATH(create([](VertexBufferDesc& desc) { desc.streams[1].attributes[0].attribute = Attribute::Uv0; }),
                 line("streams 1 and 2 both have attribute Uv0; a vertex has each of them once"));
    EXPECT_DEATH(create([](VertexBufferDesc& desc) { desc.streams[0].attributes.clear(); }),
                 line("a vertex stream has an attribute"));
    EXPECT_DEATH(create([](VertexBufferDesc& desc) { desc.streams.push_back(desc.streams[0]); }),
                 line("4 vertex streams, but at most 3 can be bound"));
    const auto update = [](uint32_t stream, size_t bytes) {
        StreamStage stage(Backend::Null, Layout::PositionsFirst);
        const std::vector<std::byte> data(bytes);
        stage.engine.update(stage.vertices, data, 0, stream);
    };
    const char* const call = "Engine::update(VertexBuffer, span<byte>, uint32_t, uint32_t): ";
    EXPECT_DEATH(update(3, 16), test::misuseLine(std::string(call) + "streams 3 to 4 are changed, but there are 3"));
    EXPECT_DEATH(update(2, 24),
                 test::misuseLine(std::string(call) +
                                  "`data` has 24 bytes, which is no whole number of vertices of 16 bytes"));
}

// The missing attribute is named whichever stream should have had it.
TEST(VertexStreams, LackWhatAMaterialReadsByName) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const auto add = [] {
        StreamStage stage(Backend::Null, Layout::PositionsFirst);
        VertexBufferDesc desc = Streams(ball()).desc(true);
        desc.streams.erase(desc.streams.begin()); // positions and colours
        const VertexBuffer vertices = stage.engine.create(desc);
        stage.scene.setGeometry(stage.copies[0],
                                { .vertices = vertices, .indices = stage.engine.create(ball().indexBuffer()) });
    };
    EXPECT_DEATH(add(), "the vertex buffer lacks what material .* reads: Tangents");
}

} // namespace
} // namespace filament_core
