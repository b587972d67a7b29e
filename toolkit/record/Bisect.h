// SPDX-License-Identifier: Apache-2.0
/// bisect: finds the first pass, then the first draw, after which two sources that draw the same frame disagree.
///   In      two sources: stages of filament-conformance (insideOf()), or traces that are replayed.
///   Out     nothing if every attachment of every pass has the same bits.
///   Method  compares all attachments of both in the order of the passes; then finds N by binary search, cutting frames
///           off after N draws and comparing the attachment again.
///           Where one device merges passes that the other one cannot merge, as without framebuffer fetch, attachments
///           are compared by name: after some pass they must hold the same. No draw is searched for.
///   Fails   errors of the sources; Unsupported if the two frames have different passes for another reason.
///   Cost    one frame per source, and one more for every step of the search.
#pragma once

#include "backend/layers/Captured.h"
#include "base/Result.h"
#include "toolkit/pictures/Pixels.h"

#include <functional>

namespace filament_core::tools {

struct Disagreement {
    std::string pass, attachment;
    uint32_t passFirst = 0, passLast = 0; ///< command positions in the frame
    Format format = Format::None;
    PixelDifference pixel{};     ///< the first one that differs after the pass
    bool hasDraw = false;        ///< false: the pass differs before its first draw
    uint32_t draw = 0;           ///< number within the frame, from 1
    uint32_t drawPosition = 0;   ///< command position in the frame
    std::string pipeline;        ///< its debug name
    PixelDifference afterDraw{}; ///< the first pixel that differs right after it
    std::string line() const;    ///< everything as one line of text
};

/// Draws the frame again, cut off after `drawLimit` draws: all of its attachments.
using FrameSource = std::function<Result<backend::CapturedFrame>(uint32_t drawLimit)>;

Result<std::optional<Disagreement>> bisect(FrameSource const& a, FrameSource const& b);

/// The first attachment that differs between two captured frames, without its draw.
Result<std::optional<Disagreement>> compareFrames(backend::CapturedFrame const& a, backend::CapturedFrame const& b);

} // namespace filament_core::tools
