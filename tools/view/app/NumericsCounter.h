// SPDX-License-Identifier: Apache-2.0
/// NumericsCounter: how many pixels DebugView::Numerics marks in the frame that is shown, and the legend of its
/// colours.
///   Use      after each frame, before the interface is drawn over it: follow(); in every step: poll(); between ImGui's
///            NewFrame() and Render(): draw().
///   Counts   the marks of the image itself (<filament_core/DebugViews.h>), so that they agree with what is seen. They
///            come a frame or two later; until they are those of the newest frame, the legend marks them.
///   Places   the image is a part of the window, at `offset`.
///   Waits    never.   Memory: an image while it is read back.
///   Thread   the main thread.
#pragma once

#include "tools/view/document/Document.h"
#include "tools/view/stage/Stage.h"

#include <filament_core/DebugViews.h>

#include <optional>

namespace filament_core::view {

class NumericsCounter {
public:
    /// Requests the drawn image, if its view is the one with marks and no other request is pending.
    void follow(Stage& stage, SwapChain chain, uint2 offset);
    /// True: the counts have changed, or a newer image has to be read: draw again.
    bool poll(Stage& stage);
    void draw(uint2 offset, uint2 size) const;
    void close() { *this = {}; } ///< before the renderer that reads images ends

    bool isWaiting() const { return static_cast<bool>(mPending); }
    /// Of the last image that was read; none: another view is shown.
    std::optional<NumericsCounts> const& counts() const { return mCounts; }

private:
    std::optional<NumericsCounts> mCounts;
    PixelTicket mPending{};
    uint64_t mFrame = 0, mPendingFrame = 0; ///< frames that were drawn, and the one that is being read
    Document mDocument{};                   ///< of mPendingFrame
    uint2 mOffset{ 0 };                     ///< of its image
    uint64_t mGeneration = 0;
    bool mIsNewest = false;
};

} // namespace filament_core::view
