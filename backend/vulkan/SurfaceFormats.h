// SPDX-License-Identifier: Apache-2.0
/// SurfaceFormats: which of the formats and colour spaces that a surface offers take an image as it is.
///   In      the list of vkGetPhysicalDeviceSurfaceFormatsKHR.
///   Never   a format that converts to sRGB: what is copied is encoded already.
///   Thread  any; pure.   Fails: never.
#pragma once

#include "backend/vulkan/Api.h"

#include <filament_core/Format.h>
#include <filament_core/OutputSpace.h>

#include <optional>
#include <span>
#include <vector>

namespace filament_core::backend::vulkan {

/// For images of `format` whose codes are of `space`. Ten bits become eight where the window has no ten, except in PQ,
/// which would show bands (ITU-R BT.2100 has ten at least). None: it is not offered.
std::optional<VkSurfaceFormatKHR> chooseSurfaceFormat(std::span<const VkSurfaceFormatKHR> offered, Format format,
                                                      OutputSpace space);

/// Those that have a format of some image, in the order of the enumeration.
std::vector<OutputSpace> spacesOf(std::span<const VkSurfaceFormatKHR> offered);

} // namespace filament_core::backend::vulkan
