// SPDX-License-Identifier: Apache-2.0
// Which formats are chosen from lists that displays with wide colours offer; no driver here has such a display.
#include "backend/vulkan/SurfaceFormats.h"

#include <gtest/gtest.h>

namespace filament_core::backend::vulkan {
namespace {

constexpr VkColorSpaceKHR kSrgb = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR, kHdr10 = VK_COLOR_SPACE_HDR10_ST2084_EXT,
                          kLinear = VK_COLOR_SPACE_EXTENDED_SRGB_LINEAR_EXT,
                          kP3 = VK_COLOR_SPACE_DISPLAY_P3_NONLINEAR_EXT;
using Formats = std::vector<VkSurfaceFormatKHR>;

/// As a desktop driver lists them: pairs that no image of ours fits are among them.
const Formats kWide{ { VK_FORMAT_B8G8R8A8_SRGB, kSrgb },
                     { VK_FORMAT_B8G8R8A8_UNORM, kSrgb },
                     { VK_FORMAT_A2R10G10B10_UNORM_PACK32, kSrgb },
                     { VK_FORMAT_B8G8R8A8_UNORM, kHdr10 },
                     { VK_FORMAT_A2B10G10R10_UNORM_PACK32, kHdr10 },
                     { VK_FORMAT_R16G16B16A16_SFLOAT, kLinear },
                     { VK_FORMAT_R16G16B16A16_SFLOAT, kHdr10 },
                     { VK_FORMAT_R8G8B8A8_UNORM, kP3 } };

VkFormat chosen(Formats const& offered, Format format, OutputSpace space) {
    const auto found = chooseSurfaceFormat(offered, format, space);
    return found ? found->format : VK_FORMAT_UNDEFINED;
}

TEST(SurfaceFormats, TakeTheCodesOfTheImageInItsColorSpace) {
    EXPECT_EQ(chosen(kWide, Format::RGBA8, OutputSpace::Srgb), VK_FORMAT_B8G8R8A8_UNORM) << "none that converts";
    EXPECT_EQ(chosen(kWide, Format::RGB10A2, OutputSpace::Srgb), VK_FORMAT_A2R10G10B10_UNORM_PACK32);
    EXPECT_EQ(chosen(kWide, Format::RGB10A2, OutputSpace::Rec2020Pq), VK_FORMAT_A2B10G10R10_UNORM_PACK32);
    EXPECT_EQ(chosen(kWide, Format::RGBA16F, OutputSpace::LinearRec709), VK_FORMAT_R16G16B16A16_SFLOAT);
    EXPECT_EQ(chosen(kWide, Format::RGB10A2, OutputSpace::DisplayP3), VK_FORMAT_R8G8B8A8_UNORM) << "ten bits as eight";
    EXPECT_EQ(chooseSurfaceFormat(kWide, Format::RGB10A2, OutputSpace::Rec2020Pq)->colorSpace, kHdr10);
}

TEST(SurfaceFormats, OfPqAreNoneOfEightBits) {
    const Formats eight{ { VK_FORMAT_B8G8R8A8_UNORM, kSrgb }, { VK_FORMAT_B8G8R8A8_UNORM, kHdr10 } };
    EXPECT_EQ(chosen(eight, Format::RGB10A2, OutputSpace::Rec2020Pq), VK_FORMAT_UNDEFINED);
    EXPECT_EQ(chosen(eight, Format::RGB10A2, OutputSpace::Srgb), VK_FORMAT_B8G8R8A8_UNORM);
}

TEST(SurfaceFormats, SayWhichColorSpacesAWindowHas) {
    EXPECT_EQ(spacesOf(kWide), (std::vector{ OutputSpace::Srgb, OutputSpace::LinearRec709, OutputSpace::DisplayP3,
                                             OutputSpace::Rec2020Pq }));
    EXPECT_EQ(spacesOf(Formats{ { VK_FORMAT_B8G8R8A8_UNORM, kSrgb } }), std::vector{ OutputSpace::Srgb });
    EXPECT_EQ(spacesOf(Formats{ { VK_FORMAT_A2B10G10R10_UNORM_PACK32, kHdr10 } }),
              std::vector{ OutputSpace::Rec2020Pq });
    EXPECT_TRUE(spacesOf({}).empty());
}

} // namespace
} // namespace filament_core::backend::vulkan
