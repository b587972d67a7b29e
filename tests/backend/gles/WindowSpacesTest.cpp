// SPDX-License-Identifier: Apache-2.0
// Colour spaces of windows by the extensions of EGL; no driver here has any but sRGB.
#include "backend/gles/WindowSpaces.h"

#include <gtest/gtest.h>

namespace filament_core::backend::gles {
namespace {

constexpr const char* kAll = "EGL_KHR_gl_colorspace EGL_EXT_gl_colorspace_bt2020_pq EGL_EXT_gl_colorspace_scrgb_linear "
                             "EGL_EXT_gl_colorspace_display_p3_passthrough";

TEST(WindowSpaces, NeedTheirExtensionsAndConfigurations) {
    EXPECT_EQ(spacesOf(kAll, true, true), (std::vector{ OutputSpace::Srgb, OutputSpace::LinearRec709,
                                                        OutputSpace::DisplayP3, OutputSpace::Rec2020Pq }));
    EXPECT_EQ(spacesOf(kAll, false, false), (std::vector{ OutputSpace::Srgb, OutputSpace::DisplayP3 }));
    EXPECT_EQ(spacesOf("EGL_EXT_gl_colorspace_bt2020_pq", true, true), std::vector{ OutputSpace::Srgb })
            << "without EGL_KHR_gl_colorspace no surface takes the attribute";
    EXPECT_EQ(spacesOf("EGL_KHR_gl_colorspace EGL_EXT_gl_colorspace_display_p3", true, true),
              std::vector{ OutputSpace::Srgb })
            << "that one encodes what is encoded";
    EXPECT_EQ(spacesOf("", true, true), std::vector{ OutputSpace::Srgb });
}

TEST(WindowSpaces, HaveAsManyBitsAsTheyNeed) {
    EXPECT_EQ(channelsOf(OutputSpace::Srgb).bits, 8);
    EXPECT_EQ(channelsOf(OutputSpace::Rec2020Pq).bits, 10);
    EXPECT_TRUE(channelsOf(OutputSpace::LinearRec709).isFloat);
    EXPECT_EQ(colorSpaceOf(OutputSpace::Srgb), EGL_NONE) << "the default does not convert";
    EXPECT_EQ(colorSpaceOf(OutputSpace::Rec2020Pq), EGL_GL_COLORSPACE_BT2020_PQ_EXT);
}

} // namespace
} // namespace filament_core::backend::gles
