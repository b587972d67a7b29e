// SPDX-License-Identifier: Apache-2.0
/// Images with transparent backgrounds, for files: colours of PNG are not multiplied by alpha, those of frames are.
#pragma once

#include <filament_core/Image.h>

namespace filament_core {

/// The image with its colours divided by alpha: savePng(path, straightAlpha(image)).
///   In       what views with a transparent clearColor leave: light multiplied by alpha
///   RGBA8    and RGBA8Srgb, codes of sRGB: the light is divided, at most 1, and rounded to the nearest code
///   RGBA16F  and RGBA32F: the numbers are divided; at most 65504 in RGBA16F
///   Limits   Where alpha is 0, colours become 0: light without a surface, such as bloom, has no straight colour. Tone
///            mappers bend the sum of what is in a pixel: the colours of edges are exact with ToneMapper::Linear only.
///   Fails    other formats are a mistake of the caller.
Image straightAlpha(Image image);

} // namespace filament_core
