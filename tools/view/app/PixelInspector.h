// SPDX-License-Identifier: Apache-2.0
/// PixelInspector: what both APIs have for the pixel under the pointer: it draws the document on two engines of its
/// own, which read back everything inside of a frame (backend/layers/Captured.h), and picks the pixel.
///   Use      every step: follow(). Off, it has no engines and costs nothing; it starts with the first follow() that is
///            on.
///   Draws    two frames on each engine for every document, one after the other; a pick for every pixel. For a locked
///            pixel that is explained, what explainPixel() draws.
///   Waits    never, except for the start of the engines and for an explanation.
///   Memory   the images and those attachments of one frame of each API that have the pixels of the image.
///   Thread   the main thread.
///   Fails    takeMessages(), one line each; an API that has no driver leaves its column empty.
#pragma once

#include "tools/view/compare/PixelReport.h"
#include "tools/view/document/Document.h"
#include "tools/view/stage/Stage.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::view {

/// One API.
class InspectedEngine {
public:
    static Result<std::unique_ptr<InspectedEngine>> create(Backend backend, EngineOptions const& options);

    /// Draws the document, unless it has, and requests the pixel; explains it, if that is asked for and not done yet.
    /// True: there is something new.
    bool follow(Document const& document, uint2 pixel, bool explains);
    /// Null: not drawn yet.
    InspectedFrame const* frame() const { return mFrame ? &*mFrame : nullptr; }
    bool isWaiting() const; ///< frame() is not that of the document, or its surface not that of the pixel
    std::string const& name() const { return mName; }
    std::vector<std::string> takeMessages();

private:
    InspectedEngine(std::unique_ptr<Stage> stage, std::shared_ptr<backend::FrameCapture> capture);
    void startPicture();
    void startNormals();
    bool takePicture();
    bool takeNormals();
    bool takePick();
    bool explain(uint2 pixel);
    PixelSurface surfaceOf(PickHit const& hit) const;

    std::shared_ptr<backend::FrameCapture> mCapture;
    std::unique_ptr<Stage> mStage;
    std::string mName;
    Owned<SwapChain> mChain, mLightChain;
    uint2 mSize{ 0 };
    Document mDocument{}; ///< that is drawn or on its way
    bool mHasDocument = false, mWasLoading = false;
    PixelTicket mPicture{}, mNormals{};
    PickTicket mPick{};
    uint2 mPicking{ 0 };            ///< the pixel of mPick
    std::optional<uint2> mPicked{}; ///< of the surface
    std::optional<uint2> mExplained{};
    bool mExplains = false;
    std::optional<InspectedFrame> mNext, mFrame;
    bool mNeedsNormals = false;
    std::vector<std::string> mMessages;
};

class PixelInspector {
public:
    /// The last pixel of the image under the pointer.
    void point(uint2 pixel) { mPointer = pixel; }
    void toggleLock();
    void toggleExplanation() { mExplains = !mExplains; } ///< of locked pixels
    std::optional<uint2> locked() const { return mLocked; }
    /// `options` are those of the viewer's own engine. True: the report is another one.
    bool follow(bool isOn, Document const& document, EngineOptions const& options);
    bool isWaiting() const;
    PixelReport const& report() const { return mReport; }
    void close(); ///< the engines
    std::vector<std::string> takeMessages() { return std::exchange(mMessages, {}); }

private:
    void open(EngineOptions const& options);
    void makeReport();

    std::array<std::unique_ptr<InspectedEngine>, 2> mEngines{}; ///< of the window's API, and of the other one
    bool mIsOpen = false;
    Backend mOwn = Backend::Null;
    uint2 mPointer{ 0 }, mShown{ 0 };
    std::optional<uint2> mLocked;
    bool mExplains = false;
    PixelReport mReport{};
    std::vector<std::string> mMessages;
};

} // namespace filament_core::view
