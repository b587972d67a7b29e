// SPDX-License-Identifier: Apache-2.0
// Every built-in material on both APIs, against closed forms and against each other; their parameters against the table
// of docs/built-in-materials.md.
#include "tests/filament_core/engine/materials/MaterialStage.h"
#include "toolkit/materials/PlainMaterials.h"

#include <filament_core/BuiltInMaterials.h>
#include <filament_core/Primitives.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <numbers>
#include <regex>
#include <set>

namespace filament_core {
namespace {

using test::centerPixel;
using test::halfPixel;
using test::MaterialStage;

constexpr float3 kLavender{ 0.5f, 0.25f, 0.75f }; // exact in half floats

MaterialInstance builtIn(MaterialStage& stage, std::string_view name) {
    const Result<Material> material = createBuiltInMaterial(stage.engine, name);
    EXPECT_TRUE(material) << (material ? "" : material.error().message);
    return material ? stage.keep(*material) : MaterialInstance{};
}

Renderable addMesh(MaterialStage& stage, Mesh const& mesh, MaterialInstance material,
                   double4x4 const& world = double4x4(1)) {
    auto vertices = std::make_shared<Owned<VertexBuffer>>(stage.engine.own(stage.engine.create(mesh.vertexBuffer())));
    auto indices = std::make_shared<Owned<IndexBuffer>>(stage.engine.own(stage.engine.create(mesh.indexBuffer())));
    stage.keep(vertices);
    stage.keep(indices);
    return stage.scene.add({ .vertices = *vertices,
                             .indices = *indices,
                             .material = material,
                             .bounds = mesh.bounds(),
                             .worldFromObject = world });
}

void addWires(MaterialStage& stage, Mesh const& mesh, MaterialInstance material,
              double4x4 const& world = double4x4(1)) {
    const Result<LineQuads> lines = makeWireframe(mesh);
    ASSERT_TRUE(lines) << lines.error().message;
    auto vertices = std::make_shared<Owned<VertexBuffer>>(stage.engine.own(stage.engine.create(lines->vertexBuffer())));
    auto indices = std::make_shared<Owned<IndexBuffer>>(stage.engine.own(stage.engine.create(lines->indexBuffer())));
    stage.keep(vertices);
    stage.keep(indices);
    stage.scene.add({ .vertices = *vertices,
                      .indices = *indices,
                      .material = material,
                      .worldFromObject = world,
                      .culled = false });
}

/// A plane of 8 m that faces the camera, 4 m away, and fills the screen.
Mesh wallMesh() {
    Mesh mesh = std::move(*makePlane({ 8, 8, 2, 2 }));
    for (MeshVertex& vertex : mesh.vertices) {
        vertex.position = { vertex.position.x, -vertex.position.z, 0 };
        vertex.normal = { 0, 0, 1 };
        vertex.color = float4(kLavender, 1);
    }
    EXPECT_TRUE(computeTangents(mesh));
    return mesh;
}

/// One texel of that value exactly.
Texture exactTexel(MaterialStage& stage, float4 value) {
    return stage.own(stage.engine.create(
            TextureDesc{ .format = Format::RGBA32F, .pixels = std::as_bytes(std::span(&value, 1)), .name = "texel" }));
}

TEST(BuiltInMaterials, WithoutLightShowTheirColorsExactly) {
    const auto seen = [](std::string_view name, auto const& paint) {
        return centerPixel(test::onBothApis([&](MaterialStage& stage) {
            const MaterialInstance instance = builtIn(stage, name);
            paint(stage, instance);
            addMesh(stage, wallMesh(), instance);
        }));
    };
    const auto nothing = [](MaterialStage&, MaterialInstance) {};
    const auto color = [](MaterialStage& stage, MaterialInstance instance) {
        EXPECT_TRUE(stage.engine.set(instance, "baseColor", kLavender));
    };
    const auto texture = [](MaterialStage& stage, MaterialInstance instance) {
        EXPECT_TRUE(stage.engine.set(instance, "baseColorMap", exactTexel(stage, float4(kLavender, 0))));
    };
    EXPECT_EQ(seen("unlit", nothing), float4(1)) << "white to begin with";
    EXPECT_EQ(seen("unlit", color), float4(kLavender, 1));
    EXPECT_EQ(seen("unlitTextured", nothing), float4(1));
    EXPECT_EQ(seen("unlitTextured", color), float4(kLavender, 1));
    EXPECT_EQ(seen("unlitTextured", texture), float4(kLavender, 1)) << "its alpha is not used";
    EXPECT_EQ(seen("vertexColors", nothing), float4(kLavender, 1));
    EXPECT_EQ(seen("vertexColors", color), float4(kLavender * kLavender, 1));
}

/// A sun of 1000 lx that shines along the camera, on a wall with this material.
template <class Paint>
Image litWall(std::string_view name, Paint const& paint, float lux = 1000) {
    return test::onBothApis([&](MaterialStage& stage) {
        const MaterialInstance instance = builtIn(stage, name);
        paint(stage, instance);
        addMesh(stage, wallMesh(), instance);
        stage.scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ lux } });
        stage.view.camera.exposure = { .aperture = 1, .shutterSeconds = 1, .iso = 100 }; // EV100 = 0
    });
}

TEST(BuiltInMaterials, UnderASunReflectAsLambertSays) {
    const float4 seen = centerPixel(litWall("lit", [](MaterialStage& stage, MaterialInstance instance) {
        EXPECT_TRUE(stage.engine.set(instance, "baseColor", kLavender));
        EXPECT_TRUE(stage.engine.set(instance, "roughness", 1.0f));
        EXPECT_TRUE(stage.engine.set(instance, "reflectance", 0.0f));
    }));
    const float3 expected = kLavender * (1000 / std::numbers::pi_v<float>)*Exposure{ 1, 1, 100 }.factor();
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 0.02f * expected[c]) << c;
}

TEST(BuiltInMaterials, EmitNits) {
    const float4 seen = centerPixel(litWall(
            "lit",
            [](MaterialStage& stage, MaterialInstance instance) {
                EXPECT_TRUE(stage.engine.set(instance, "emissive", float3(1, 2, 0.5f)));
            },
            0));
    const float factor = Exposure{ 1, 1, 100 }.factor();
    EXPECT_NEAR(seen.x, factor, 0.001f);
    EXPECT_NEAR(seen.y, 2 * factor, 0.001f);
    EXPECT_NEAR(seen.z, 0.5f * factor, 0.001f);
}

TEST(BuiltInMaterials, TakeTheSameColorFromAParameterATextureOrTheVertices) {
    const Image plain = litWall("lit", [](MaterialStage& stage, MaterialInstance instance) {
        EXPECT_TRUE(stage.engine.set(instance, "baseColor", kLavender));
    });
    const Image textured = litWall("litTextured", [](MaterialStage& stage, MaterialInstance instance) {
        EXPECT_TRUE(stage.engine.set(instance, "baseColorMap", exactTexel(stage, float4(kLavender, 0))));
    });
    const Image colored = litWall("litVertexColors", [](MaterialStage&, MaterialInstance) {});
    EXPECT_EQ(plain.pixels, textured.pixels);
    EXPECT_EQ(plain.pixels, colored.pixels);
}

TEST(BuiltInMaterials, BeginWithTheValuesOfTheirTable) {
    const std::map<std::string, ParameterValue> values{ { "baseColor", float3(1) },
                                                        { "metallic", 0.0f },
                                                        { "roughness", 0.5f },
                                                        { "reflectance", 0.5f },
                                                        { "emissive", float3(0) } };
    for (const std::string_view name : { "lit", "litTextured", "litVertexColors" }) {
        const Image untouched = litWall(name, [](MaterialStage&, MaterialInstance) {});
        const Image set = litWall(name, [&](MaterialStage& stage, MaterialInstance instance) {
            for (auto const& [parameter, value] : values) EXPECT_TRUE(stage.engine.set(instance, parameter, value));
        });
        EXPECT_EQ(untouched.pixels, set.pixels) << name;
        EXPECT_GT(centerPixel(untouched).x, 0.01f);
    }
}

TEST(BuiltInMaterials, ShowTexturesUpright) {
    // red | green
    // blue | white
    constexpr std::array<uint8_t, 16> kTexels{ 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255 };
    const Image seen = test::onBothApis([&](MaterialStage& stage) {
        const Texture texture = stage.own(stage.engine.create(TextureDesc{
                .width = 2, .height = 2, .pixels = std::as_bytes(std::span(kTexels)), .name = "corners" }));
        const MaterialInstance instance = builtIn(stage, "unlitTextured");
        EXPECT_TRUE(stage.engine.set(instance, "baseColorMap", texture, kUnfilteredSampler));
        addMesh(stage, wallMesh(), instance);
    });
    EXPECT_EQ(halfPixel(seen, 1, 1), float4(1, 0, 0, 1));
    EXPECT_EQ(halfPixel(seen, 6, 1), float4(0, 1, 0, 1));
    EXPECT_EQ(halfPixel(seen, 1, 6), float4(0, 0, 1, 1));
    EXPECT_EQ(halfPixel(seen, 6, 6), float4(1));
}

constexpr uint2 kWirePicture{ 64, 64 };

/// The wall with two quads each way: lines at x = -4, 0, 4 and y = -4, 0, 4, and the diagonals.
template <class Paint>
Image wiredWall(Paint const& paint, bool isSolid, double4x4 const& world = double4x4(1)) {
    return test::onBothApis([&](MaterialStage& stage) {
        if (isSolid) {
            const MaterialInstance solid = builtIn(stage, "unlit");
            EXPECT_TRUE(stage.engine.set(solid, "baseColor", float3(0, 0, 1)));
            addMesh(stage, wallMesh(), solid, world);
        }
        const MaterialInstance wires = builtIn(stage, "wireframe");
        paint(stage.engine, wires);
        addWires(stage, wallMesh(), wires, world);
        stage.view.size = kWirePicture;
    });
}

size_t wirePixels(Image const& image) {
    size_t count = 0;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) count += halfPixel(image, x, y).x > 0.25f; // what is solid is blue
    }
    return count;
}

/// In view: a vertical and a horizontal through the middle, and one diagonal; the others pass the corners of the
/// image.
size_t expectedWirePixels(double width) {
    size_t count = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const auto isInside = [&](double distance) { return distance >= -width / 2 && distance < width / 2; };
            count += isInside(x + 0.5 - 32) || isInside(y + 0.5 - 32) || isInside((x + y - 63) / std::sqrt(2.0));
        }
    }
    return count;
}

TEST(Wireframe, LinesHaveTheirWidthInPixels) {
    const auto drawn = [](float width) {
        return static_cast<double>(wirePixels(wiredWall(
                [=](Engine& engine, MaterialInstance wires) { EXPECT_TRUE(engine.set(wires, "lineWidth", width)); },
                false)));
    };
    const auto untouched = [](Engine&, MaterialInstance) {};
    EXPECT_EQ(static_cast<double>(wirePixels(wiredWall(untouched, false))), drawn(1)) << "one pixel to begin with";
    for (const float width : { 1.0f, 3.0f, 6.0f })
        EXPECT_NEAR(drawn(width), static_cast<double>(expectedWirePixels(width)), 2) << width;
    EXPECT_EQ(drawn(0), 0);
}

// 45 degrees, and 22.5 more at the rim of the image: less than the 76 of the bias.
TEST(Wireframe, LinesHideTheSurfaceWhoseEdgesTheyAre) {
    const auto biased = [](float slope, float width) {
        return [=](Engine& engine, MaterialInstance wires) {
            EXPECT_TRUE(engine.set(wires, "depthBias", slope));
            EXPECT_TRUE(engine.set(wires, "lineWidth", width));
        };
    };
    for (const double degrees : { 0.0, 30.0, -45.0 }) {
        const double4x4 turned = glm::rotate(double4x4(1), glm::radians(degrees), double3(0.6, 0.8, 0));
        for (const float width : { 1.0f, 4.0f }) {
            const auto alone = static_cast<double>(wirePixels(wiredWall(biased(0, width), false, turned)));
            EXPECT_GT(alone, 100);
            EXPECT_NEAR(static_cast<double>(wirePixels(wiredWall(biased(4, width), false, turned))), alone,
                        0.02 * alone)
                    << "the bias moves no line";
            EXPECT_NEAR(static_cast<double>(wirePixels(wiredWall(biased(4, width), true, turned))), alone, 0.02 * alone)
                    << degrees << " " << width;
            if (degrees != 0) {
                EXPECT_LT(static_cast<double>(wirePixels(wiredWall(biased(0, width), true, turned))), 0.8 * alone)
                        << "what the bias is for";
            }
        }
    }
}

TEST(Wireframe, OfAMirroredObjectIsDrawn) {
    const auto nothing = [](Engine&, MaterialInstance) {};
    EXPECT_GT(wirePixels(wiredWall(nothing, false, glm::scale(double4x4(1), double3(-1, 1, 1)))), 100u);
}

TEST(BuiltInMaterials, AreKnownByNameAndSuggestTheNearest) {
    const std::optional<Engine> engine = [] { return test::makeEngine(Backend::Gles); }();
    ASSERT_TRUE(engine);
    auto& owner = const_cast<Engine&>(*engine);
    std::set<std::string_view> names;
    for (BuiltInMaterial const& material : builtInMaterials()) {
        EXPECT_TRUE(names.insert(material.name).second);
        EXPECT_FALSE(material.summary.empty());
        const Result<Material> created = createBuiltInMaterial(owner, material.name);
        ASSERT_TRUE(created) << created.error().message;
        EXPECT_EQ(owner.describe(*created).name, material.name);
        owner.destroy(*created);
    }
    EXPECT_EQ(names.size(), 10u);
    const std::string all = "; there are lit, unlit, litTextured, unlitTextured, litVertexColors, vertexColors, "
                            "shadowCatcher, litShadowCatcher, wireframe, points";
    const auto message = [&](std::string_view name) { return createBuiltInMaterial(owner, name).error().message; };
    EXPECT_EQ(message("wirefame"), "no built-in material 'wirefame'; did you mean 'wireframe'?" + all);
    EXPECT_EQ(message("litTexture"), "no built-in material 'litTexture'; did you mean 'litTextured'?" + all);
    EXPECT_EQ(message("somethingElse"), "no built-in material 'somethingElse'" + all);
    EXPECT_EQ(createBuiltInMaterial(owner, "").error().code, ErrorCode::NotFound);
    test::expectNoErrors(owner);
}

/// "lit.roughness float", of every row of the page's table.
std::set<std::string> documentedParameters() {
    std::ifstream page(tools::sourceDir() / "docs/built-in-materials.md");
    EXPECT_TRUE(page) << "docs/built-in-materials.md";
    static const std::regex kRow(R"(\| `(\w+)` \| (\w+) \| [^|]* \| ([^|]*) \|.*)"), kName(R"(`(\w+)`)");
    std::set<std::string> found;
    for (std::string line; std::getline(page, line);) {
        std::smatch row;
        if (!std::regex_match(line, row, kRow)) continue;
        const std::string materials = row[3];
        for (std::sregex_iterator name(materials.begin(), materials.end(), kName), end; name != end; ++name)
            found.insert((*name)[1].str() + "." + row[1].str() + " " + row[2].str());
    }
    return found;
}

TEST(BuiltInMaterials, HaveTheParametersOfTheirPageAndTheAttributesOfAMesh) {
    auto engine = test::makeEngine(Backend::Vulkan);
    ASSERT_TRUE(engine);
    uint32_t ofMesh = 0;
    const Mesh mesh = wallMesh();
    for (AttributeDesc const& attribute : mesh.vertexBuffer().attributes)
        ofMesh |= 1u << static_cast<int>(attribute.attribute);
    std::set<std::string> declared;
    for (BuiltInMaterial const& material : builtInMaterials()) {
        const Owned<Material> created = engine->own(*createBuiltInMaterial(*engine, material.name));
        MaterialDescription const& description = engine->describe(created);
        if (material.name != "wireframe") {
            EXPECT_EQ(description.requiredAttributes & ~ofMesh, 0u) << material.name;
        }
        for (ParameterDescription const& parameter : description.parameters)
            declared.insert(std::string(material.name) + "." + parameter.name + " " + toString(parameter.type));
    }
    EXPECT_EQ(declared, documentedParameters());
}

TEST(BuiltInMaterials, CanBeCompiledAheadAndDrawWithoutExactShaders) {
    for (const Backend backend : test::kBothApis) {
        auto engine = Engine::create({ .backend = backend,
                                       .workers = 0,
                                       .validation = true,
                                       .exactShaders = false,
                                       .debug = { .plainMaterials = &tools::plainMaterial } });
        ASSERT_TRUE(engine) << engine.error().message;
        for (BuiltInMaterial const& material : builtInMaterials()) {
            if (material.name == "wireframe" || material.name == "points" || material.name.ends_with("hadowCatcher"))
                continue; // other vertices; unseen
            MaterialStage stage(*engine);
            const MaterialInstance instance = builtIn(stage, material.name);
            addMesh(stage, wallMesh(), instance);
            stage.scene.add(SunLight{ .directionWorld = { 0, 0, -1 } });
            EXPECT_GT(centerPixel(test::renderLinear(*engine, stage.scene, stage.view)).x, 0.05f) << material.name;
        }
        test::expectNoErrors(*engine);
    }
}

} // namespace
} // namespace filament_core
