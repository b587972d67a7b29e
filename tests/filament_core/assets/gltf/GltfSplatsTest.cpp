// SPDX-License-Identifier: Apache-2.0
// KHR_gaussian_splatting: what the loader reads of splats, what it repairs, and what it refuses.
#include "filament_core/assets/gltf/ModelBounds.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

#include <limits>

namespace filament_core::assets::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kSplats = "KHR_gaussian_splatting";

void splatAttribute(TestFile& file, std::string const& name, std::vector<float> const& values, const char* type,
                    size_t perElement) {
    file.attribute((std::string(kSplats) + ":" + name).c_str(), values, kFloat, type, perElement);
}

/// Two splats of degree 0.
TestFile twoSplats() {
    TestFile file;
    file.positions({ 1, 2, 3, -1, 0, 0 });
    splatAttribute(file, "ROTATION", { 0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f }, "VEC4", 4);
    splatAttribute(file, "SCALE", { 0.1f, 0.2f, 0.3f, 1, 2, 0 }, "VEC3", 3);
    splatAttribute(file, "OPACITY", { 0.5f, 1 }, "SCALAR", 1);
    splatAttribute(file, "SH_DEGREE_0_COEF_0", { 0.1f, 0.2f, 0.3f, -0.1f, 0, 1 }, "VEC3", 3);
    file.primitive()["mode"] = 0;
    file.primitive()["extensions"][kSplats] = { { "kernel", "ellipse" }, { "colorSpace", "srgb_rec709_display" } };
    file.root["extensionsUsed"] = { kSplats };
    return file;
}

void addDegree(TestFile& file, int degree, int count) {
    for (int i = 0; i < count; ++i)
        splatAttribute(file, "SH_DEGREE_" + std::to_string(degree) + "_COEF_" + std::to_string(i),
                       std::vector<float>(6, static_cast<float>(10 * degree + i)), "VEC3", 3);
}

scene::SplatData const& splatsOf(ModelData const& model) {
    static const scene::SplatData kNothing;
    if (model.meshes.size() != 1 || model.meshes[0].primitives.size() != 1 || !model.meshes[0].primitives[0].splats) {
        ADD_FAILURE() << "expected one primitive with splats";
        return kNothing;
    }
    return *model.meshes[0].primitives[0].splats;
}

std::string splatsErrorOf(TestFile const& file) {
    const Result<ModelData> model = file.load();
    return model ? "loaded" : model.error().message;
}

TEST(GltfSplats, AreReadWithTheirCovariances) {
    const ModelData model = loaded(twoSplats());
    scene::SplatData const& splats = splatsOf(model);
    EXPECT_THAT(model.warnings, IsEmpty());
    ASSERT_EQ(splats.count(), 2u);
    EXPECT_EQ(splats.positions[0], float3(1, 2, 3));
    EXPECT_EQ(splats.opacities[0], 0.5f);
    EXPECT_EQ(splats.harmonics[1], float3(-0.1f, 0, 1));
    EXPECT_EQ(splats.degree, 0u);
    EXPECT_EQ(splats.colors, SplatColors::Srgb);
    EXPECT_FLOAT_EQ(splats.covariances[0].yy, 0.04f);
    EXPECT_FLOAT_EQ(splats.covariances[0].xy, 0);
    // A quarter turn about z exchanges x and y.
    EXPECT_NEAR(splats.covariances[1].xx, 4, 1e-6);
    EXPECT_NEAR(splats.covariances[1].yy, 1, 1e-6);
    EXPECT_NEAR(splats.covariances[1].xy, 0, 1e-6);
    EXPECT_EQ(splats.covariances[1].zz, 0);
    const Box box = boundsOf(model);
    EXPECT_NEAR(box.min.x, -1 - 3 * 2, 1e-5) << "three standard deviations around the centres";
    EXPECT_NEAR(box.max.z, 3 + 3 * 0.3, 1e-5);
}

TEST(GltfSplats, EveryComponentTypeOfTheSpecificationIsTheSameSplat) {
    const auto read = [](auto component, Component type, bool isNormalized) {
        using T = decltype(component);
        TestFile file = twoSplats();
        const auto put = [&](const char* name, std::vector<T> const& values, const char* of, size_t size) {
            file.attribute((std::string(kSplats) + ":" + name).c_str(), values, type, of, size, isNormalized);
        };
        if (std::is_signed_v<T> && isNormalized) {
            const T one = std::numeric_limits<T>::max();
            put("ROTATION", { 0, 0, 0, one, 0, 0, one, one }, "VEC4", 4);
        } else {
            if (isNormalized) put("OPACITY", { std::numeric_limits<T>::max(), 0 }, "SCALAR", 1);
            put("SCALE", { 1, 2, 3, 4, 5, 6 }, "VEC3", 3);
        }
        return file;
    };
    for (TestFile const& file : { read(int8_t{}, kByte, true), read(int16_t{}, kShort, true) }) {
        const ModelData model = loaded(file);
        EXPECT_NEAR(splatsOf(model).covariances[1].xx, 4, 1e-5) << "a quarter turn, of another length";
    }
    for (TestFile const& file : { read(uint8_t{}, kUByte, true), read(uint16_t{}, kUShort, true) }) {
        const ModelData model = loaded(file);
        EXPECT_EQ(splatsOf(model).opacities[0], 1);
        EXPECT_EQ(splatsOf(model).opacities[1], 0);
        EXPECT_LT(splatsOf(model).covariances[0].zz, 1e-3f) << "3 / 255 or less, squared";
    }
    for (TestFile const& file : { read(uint8_t{}, kUByte, false), read(uint16_t{}, kUShort, false),
                                  read(int8_t{}, kByte, false), read(int16_t{}, kShort, false) }) {
        const ModelData model = loaded(file);
        EXPECT_EQ(splatsOf(model).covariances[0].zz, 9);
    }
}

TEST(GltfSplats, HarmonicsAreThoseOfTheHighestCompleteDegree) {
    TestFile file = twoSplats();
    addDegree(file, 1, 3);
    addDegree(file, 2, 5);
    ModelData model = loaded(file);
    EXPECT_EQ(splatsOf(model).degree, 2u);
    ASSERT_EQ(splatsOf(model).harmonics.size(), 18u);
    EXPECT_EQ(splatsOf(model).harmonics[9 + 8], float3(24)) << "the last one of the second splat";
    EXPECT_EQ(splatsOf(model).harmonics[9], float3(-0.1f, 0, 1));

    addDegree(file, 3, 6); // of seven
    model = loaded(file);
    EXPECT_EQ(splatsOf(model).degree, 2u);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("coefficients of degree 3 are missing")));
    file.primitive()["attributes"].erase("KHR_gaussian_splatting:SH_DEGREE_1_COEF_1");
    EXPECT_EQ(splatsOf(loaded(file)).degree, 0u) << "degree 2 needs degree 1";
}

TEST(GltfSplats, UnknownValuesAreWarningsAndTheDefaultsAreDrawn) {
    TestFile file = twoSplats();
    Json& extension = file.primitive()["extensions"][kSplats];
    extension["colorSpace"] = "lin_rec709_display";
    EXPECT_EQ(splatsOf(loaded(file)).colors, SplatColors::Linear);
    extension = {
        { "kernel", "square" }, { "colorSpace", "p3" }, { "projection", "flat" }, { "sortingMethod", "zDepth" }
    };
    const ModelData model = loaded(file);
    EXPECT_EQ(splatsOf(model).colors, SplatColors::Srgb);
    for (const char* line :
         { "kernel: 'square' is not a value that this loader knows; ellipse is used", "colorSpace: 'p3' is not",
           "projection: 'flat' is not", "sortingMethod: 'zDepth' is not" })
        EXPECT_THAT(model.warnings, Contains(HasSubstr(line)));
}

TEST(GltfSplats, WhatIsRequiredIsAnErrorWithItsPlace) {
    const auto with = [](auto&& change) {
        TestFile file = twoSplats();
        change(file);
        return splatsErrorOf(file);
    };
    const auto without = [&](const char* attribute) {
        return with([&](TestFile& file) { file.primitive()["attributes"].erase(attribute); });
    };
    const auto broken = [&](const char* name) {
        return with([&](TestFile& file) { file.primitive()["extensions"][kSplats].erase(name); });
    };
    for (const char* name : { "POSITION", "KHR_gaussian_splatting:ROTATION", "KHR_gaussian_splatting:SCALE",
                              "KHR_gaussian_splatting:OPACITY", "KHR_gaussian_splatting:SH_DEGREE_0_COEF_0" })
        EXPECT_THAT(without(name), HasSubstr(std::string("meshes[0].primitives[0].attributes: ") + name)) << name;
    EXPECT_THAT(broken("kernel"),
                HasSubstr("meshes[0].primitives[0].extensions.KHR_gaussian_splatting.kernel: is missing"));
    EXPECT_THAT(broken("colorSpace"), HasSubstr("colorSpace: is missing"));
    EXPECT_THAT(with([](TestFile& file) { file.primitive()["mode"] = 4; }),
                HasSubstr("mode: KHR_gaussian_splatting needs"));
    EXPECT_THAT(with([](TestFile& file) { splatAttribute(file, "OPACITY", { 1 }, "SCALAR", 1); }),
                HasSubstr("OPACITY has 1 elements, POSITION has 2"));
    EXPECT_THAT(with([](TestFile& file) {
                    file.attribute("KHR_gaussian_splatting:ROTATION", std::vector<uint8_t>(8, 1), kUByte, "VEC4", 4,
                                   true);
                }),
                HasSubstr("ROTATION: accessors[5] has a component type that the extension does not allow"));
}

TEST(GltfSplats, WhatNoNodeShowsMayBeBroken) {
    TestFile file = twoSplats();
    file.root["meshes"].push_back(file.root["meshes"][0]);
    file.root["meshes"][1]["primitives"][0]["mode"] = 4;
    const ModelData model = loaded(file);
    EXPECT_EQ(splatsOf(model).count(), 2u);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("nothing that is drawn uses it")));
}

TEST(GltfSplats, ThoseOfAnUnknownCompressionAreDrawnAsPoints) {
    TestFile file = twoSplats();
    file.attribute("COLOR_0", std::vector<float>(8, 0.5f), kFloat, "VEC4", 4);
    file.primitive()["attributes"].erase("KHR_gaussian_splatting:SCALE");
    file.primitive()["extensions"][kSplats]["extensions"]["EXT_compressed"] = Json::object();
    const ModelData model = loaded(file);
    ASSERT_EQ(model.meshes[0].primitives.size(), 1u);
    PrimitiveData const& points = model.meshes[0].primitives[0];
    EXPECT_FALSE(points.splats);
    EXPECT_EQ(points.topology, backend::PrimitiveType::Points);
    EXPECT_TRUE(points.hasColor);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("they are drawn as points")));
}

TEST(GltfSplats, NumbersThatAreNotFiniteLeaveTheirSplatOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const auto check = [](TestFile const& file) {
        const ModelData model = loaded(file);
        EXPECT_EQ(splatsOf(model).count(), 1u);
        EXPECT_EQ(splatsOf(model).positions[0], float3(-1, 0, 0));
        EXPECT_THAT(model.warnings, Contains(HasSubstr("1 of 2 splats have numbers that are not finite")));
    };
    TestFile file = twoSplats();
    file.positions({ 1, nan, 3, -1, 0, 0 });
    check(file);
    file = twoSplats();
    splatAttribute(file, "ROTATION", { 0, 0, 0, infinity, 0, 0, 0, 1 }, "VEC4", 4);
    check(file);
    file = twoSplats();
    splatAttribute(file, "SCALE", { 1, 1, 1e20f, 1, 1, 1 }, "VEC3", 3);
    check(file);
    file = twoSplats();
    splatAttribute(file, "SH_DEGREE_0_COEF_0", { 0, 0, nan, 1, 1, 1 }, "VEC3", 3);
    check(file);
    splatAttribute(file, "OPACITY", { 1, nan }, "SCALAR", 1);
    const ModelData nothing = loaded(file);
    EXPECT_TRUE(nothing.meshes[0].primitives.empty());
    EXPECT_THAT(nothing.warnings, Contains(HasSubstr("is empty and is not drawn")));
}

TEST(GltfSplats, ValuesOutsideOfTheirRangesAreRepairedWithAWarning) {
    TestFile file = twoSplats();
    splatAttribute(file, "OPACITY", { -1, 7 }, "SCALAR", 1);
    splatAttribute(file, "ROTATION", { 0, 0, 0, 0, 0, 0, 3, 3 }, "VEC4", 4);
    ModelData model = loaded(file);
    EXPECT_EQ(splatsOf(model).opacities[0], 0);
    EXPECT_EQ(splatsOf(model).opacities[1], 1);
    EXPECT_FLOAT_EQ(splatsOf(model).covariances[0].xx, 0.01f) << "not rotated";
    EXPECT_NEAR(splatsOf(model).covariances[1].xx, 4, 1e-5) << "of any length";
    EXPECT_THAT(model.warnings, Contains(HasSubstr("2 splats have opacities outside of 0 to 1")));
    EXPECT_THAT(model.warnings, Contains(HasSubstr("1 splats have rotations without a length")));

    file = twoSplats();
    splatAttribute(file, "SCALE", { -2, 0, 0, 0, 1, 0 }, "VEC3", 3);
    model = loaded(file);
    EXPECT_NEAR(splatsOf(model).covariances[0].xx, std::exp(-4.0), 1e-6);
    EXPECT_FLOAT_EQ(splatsOf(model).covariances[0].yy, 1);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("all are taken as logarithms")));
}

} // namespace
} // namespace filament_core::assets::test
