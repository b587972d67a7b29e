// SPDX-License-Identifier: Apache-2.0
// _FILAMENT_TANGENTS: frames of vertices as the file has them.
#include "shaders/interface/ShaderInterface.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

namespace filament_core::assets::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

TestFile withFrames(std::vector<float> const& frames) {
    TestFile file = TestFile::triangle();
    file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    file.attribute("_FILAMENT_TANGENTS", frames, kFloat, "VEC4", 4);
    return file;
}

/// Of the first vertex, as floats.
std::vector<float> frameIn(ModelData const& model) {
    PrimitiveData const& primitive = model.meshes.at(0).primitives.at(0);
    for (uint32_t i = 0; i < primitive.layout.attributeCount; ++i) {
        backend::VertexAttribute const& attribute = primitive.layout.attributes[i];
        if (attribute.location != shader::kAttributeTangents || attribute.format != backend::VertexFormat::Float4)
            continue;
        std::vector<float> frame(4);
        std::memcpy(frame.data(), &primitive.vertices[attribute.offset], 16);
        return frame;
    }
    return {};
}

TEST(GltfFrames, FloatsKeepTheirBits) {
    const std::vector<float> frames{ 0.1f, -0.2f, 0.3f, 0.9273618f, 0, 0, 0, 1, 0, 0, 0, -1 };
    const Result<ModelData> model = withFrames(frames).load();
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_THAT(model->warnings, IsEmpty());
    EXPECT_EQ(frameIn(*model), std::vector<float>(frames.begin(), frames.begin() + 4));
}

TEST(GltfFrames, WhatIsNoUnitQuaternionIsAWarning) {
    for (const float bad : { 0.0f, 2.0f, 1e30f }) {
        const Result<ModelData> model = withFrames({ 0, 0, 0, bad, 0, 0, 0, 1, 0, 0, 0, 1 }).load();
        ASSERT_TRUE(model) << model.error().message;
        EXPECT_THAT(model->warnings,
                    Contains(HasSubstr("meshes[0].primitives[0]: _FILAMENT_TANGENTS needs unit quaternions")));
        EXPECT_THAT(frameIn(*model), IsEmpty()) << "those of the normals are packed";
    }
}

TEST(GltfFrames, OfMeshesWithoutNormalsAreLeftOut) {
    TestFile file = TestFile::triangle();
    file.attribute("_FILAMENT_TANGENTS", std::vector<float>{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }, kFloat, "VEC4", 4);
    const Result<ModelData> model = file.load();
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_THAT(model->warnings, Contains(HasSubstr("_FILAMENT_TANGENTS needs unit quaternions and a NORMAL")));
}

} // namespace
} // namespace filament_core::assets::test
