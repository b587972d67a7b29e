// SPDX-License-Identifier: Apache-2.0
/// bisect: finds the first pass, then the first draw, after which two stages that draw the same case disagree.
///   In      two stages with capture, both set() to the case.
///   Out     nothing if every attachment of every pass has the same bits.
///   Method  compares all attachments of both in the order of the passes; then finds N by binary search, cutting frames
///           off after N draws and comparing the attachment again.
///   Fails   errors of the stages; Unsupported if the two frames have different passes.
///   Cost    one frame per stage, and one more for every step of the search.
#pragma once

#include "tools/conformance/ImageChecks.h"
#include "tools/conformance/Stage.h"

namespace filament::conformance {

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

Result<std::optional<Disagreement>> bisect(Stage& a, Stage& b);

/// The first attachment that differs between two captured frames, without its draw.
Result<std::optional<Disagreement>> compareFrames(backend::CapturedFrame const& a, backend::CapturedFrame const& b);

} // namespace filament::conformance
