// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/SurfaceFormats.h"

#include <algorithm>
#include <array>

namespace filament_core::backend::vulkan {
namespace {

VkColorSpaceKHR colorSpaceOf(OutputSpace space) {
    switch (space) {
    case OutputSpace::LinearRec709:
        return VK_COLOR_SPACE_EXTENDED_SRGB_LINEAR_EXT;
    case OutputSpace::DisplayP3:
        return VK_COLOR_SPACE_DISPLAY_P3_NONLINEAR_EXT;
    case OutputSpace::Rec2020Pq:
        return VK_COLOR_SPACE_HDR10_ST2084_EXT;
    case OutputSpace::Srgb:
        break;
    }
    return VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
}

/// The best first.
std::span<const VkFormat> formatsFor(Format format, OutputSpace space) {
    static constexpr std::array kTen{ VK_FORMAT_A2B10G10R10_UNORM_PACK32, VK_FORMAT_A2R10G10B10_UNORM_PACK32,
                                      VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM };
    static constexpr std::array kHalf{ VK_FORMAT_R16G16B16A16_SFLOAT };
    const std::span<const VkFormat> ten(kTen);
    if (format == Format::RGBA16F) return kHalf;
    if (format != Format::RGB10A2) return ten.last(2);
    return space == OutputSpace::Rec2020Pq ? ten.first(2) : ten;
}

/// What a swap chain of this space has at least.
Format leastFormat(OutputSpace space) {
    return space == OutputSpace::Rec2020Pq      ? Format::RGB10A2
           : space == OutputSpace::LinearRec709 ? Format::RGBA16F
                                                : Format::RGBA8;
}

} // namespace

std::optional<VkSurfaceFormatKHR> chooseSurfaceFormat(std::span<const VkSurfaceFormatKHR> offered, Format format,
                                                      OutputSpace space) {
    for (const VkFormat wanted : formatsFor(format, space)) {
        const auto found = std::ranges::find_if(offered, [&](VkSurfaceFormatKHR const& each) {
            return each.format == wanted && each.colorSpace == colorSpaceOf(space);
        });
        if (found != offered.end()) return *found;
    }
    return std::nullopt;
}

std::vector<OutputSpace> spacesOf(std::span<const VkSurfaceFormatKHR> offered) {
    std::vector<OutputSpace> spaces;
    for (const OutputSpace space :
         { OutputSpace::Srgb, OutputSpace::LinearRec709, OutputSpace::DisplayP3, OutputSpace::Rec2020Pq }) {
        if (chooseSurfaceFormat(offered, leastFormat(space), space)) spaces.push_back(space);
    }
    return spaces;
}

} // namespace filament_core::backend::vulkan
