// SPDX-License-Identifier: Apache-2.0
// blending : opaque ignores alpha, whatever the material writes.
#include "tests/shaders/exact/PictureFixture.h"

#include <set>

namespace filament_core::shader {
namespace {

using test::MaterialScene;

class OpaqueBlending : public test::PictureFixture, public ::testing::WithParamInterface<const char*> {};

TEST_P(OpaqueBlending, IgnoresTheAlphaOfThePostLightingColor) {
    for (const char* shading : { "unlit", "lit" }) {
        MaterialScene scene;
        scene.source = std::string("material { name : post, blending : opaque, shadingModel : ") + shading +
                       ", postLightingBlending : " + GetParam() +
                       " }\nfragment { void material(inout MaterialInputs material) { prepareMaterial(material); "
                       "material.postLightingColor = vec4(0.25, 0.5, 0.75, 0.0); } }";
        const std::vector<float> picture = draw(scene);
        ASSERT_FALSE(picture.empty());
        std::set<float> alphas;
        for (size_t i = 3; i < picture.size(); i += 4) alphas.insert(picture[i]);
        const size_t center = (test::kPictureSide / 2 * test::kPictureSide + test::kPictureSide / 2) * 4;
        EXPECT_EQ(picture[center + 3], 1.0f) << shading;
        EXPECT_LE(alphas.size(), 2u) << "1, and 0 in the background";
        if (GetParam() == std::string("opaque")) {
            EXPECT_EQ(picture[center + 1], 0.5f) << shading;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Of, OpaqueBlending, ::testing::Values("opaque", "transparent", "add", "multiply", "screen"),
                         [](auto const& each) { return std::string(each.param); });

} // namespace
} // namespace filament_core::shader
