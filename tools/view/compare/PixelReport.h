// SPDX-License-Identifier: Apache-2.0
/// PixelReport: what two engines have for one pixel of the same frame: what is displayed, what is seen there, which
/// lights and effects its light is made of, and every attachment of the frame graph, as texts with a mark where bits
/// differ.
///   In       frames as FrameCapture reads them, with their images.
///   Smaller  attachments are looked at where their texels cover the pixel. Those of other shapes (shadow maps, tables)
///            have no pixel of the image; they are counted.
///   Thread   any; pure functions.
///   Fails    never: what one of the two does not have is "-", and differs.
#pragma once

#include "backend/layers/Captured.h"

#include <filament_core/ExplainPixel.h>
#include <filament_core/Image.h>
#include <filament_core/Math.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::view {

struct PixelRow {
    std::string group{};  ///< of a pass, or "picture"
    std::string name{};   ///< "color"
    std::string detail{}; ///< "RGBA16F 640x360"; a smaller one with the texel: "RGBA16F 320x180 at 7, 9"
    std::array<std::string, 2> values{};
    bool differs = false;
};

struct PixelReport {
    uint2 pixel{ 0 };
    bool isLocked = false;
    bool isExplained = false;             ///< the terms of its light are asked for
    bool isComplete = false;              ///< both engines have drawn the document as it is now
    std::array<std::string, 2> engines{}; ///< of the window, and the other one
    std::vector<PixelRow> rows{};
    uint32_t unseen = 0; ///< attachments without this pixel

    uint32_t differing() const { return static_cast<uint32_t>(std::ranges::count(rows, true, &PixelRow::differs)); }
};

/// What is seen at a pixel: the answer of a pick.
struct PixelSurface {
    std::string object{}; ///< "node 3 'lid', primitive 0"; empty: nothing is drawn there
    double distanceMeters = 0;
    double3 positionWorld{ 0 };
    friend bool operator==(PixelSurface const&, PixelSurface const&) = default;
};

/// A frame of one engine.
struct InspectedFrame {
    backend::CapturedFrame inside{};
    Image picture{};                               ///< as displayed
    Image normals{};                               ///< DebugView::Normals in a target of light: RGBA16F
    uint2 size{ 1 };                               ///< of the view
    std::optional<PixelSurface> surface{};         ///< of the pixel; none: not known yet
    std::optional<PixelExplanation> explanation{}; ///< of the pixel, if that is asked for
};

/// The texel of an attachment that covers a pixel of a view; none: its size is not that of the view or a half, a
/// quarter ... of it, rounded up or down.
std::optional<uint2> texelOf(uint2 pixel, uint2 view, uint2 attachment);

/// Null: not there yet. `pixel` is below the size of the view.
std::vector<PixelRow> pixelRows(uint2 pixel, InspectedFrame const* own, InspectedFrame const* other);
/// Of the first frame that is there.
uint32_t unseenAttachments(InspectedFrame const* own, InspectedFrame const* other);
/// Forgets the contents of attachments that pixelRows() does not read.
void dropUnseen(InspectedFrame& frame);

} // namespace filament_core::view
