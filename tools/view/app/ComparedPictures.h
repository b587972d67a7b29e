// SPDX-License-Identifier: Apache-2.0
/// ComparedPictures: the viewer's picture and that of the other API, or of the path tracer, as a live number and as
/// what lies over the picture: a wipe, or a map of differences.
///   Use      once a frame, after the scene and before the interface: follow(); between ImGui's NewFrame() and
///            Render(): draw().
///   Places   the viewer's picture is a part of the window, at `offset`. Events count pixels of the picture.
///   Waits    for nothing: pictures are compared on another thread, one pair at a time. The destructor waits for the
///            last.
///   Memory   two pictures on the host, and a texture of the map.
///   Thread   the main thread.
#pragma once

#include "tools/view/app/InputEvent.h"
#include "tools/view/app/PictureSource.h"
#include "tools/view/compare/Comparison.h"
#include "tools/view/stage/Background.h"
#include "tools/view/stage/Stage.h"
#include "tools/view/ui/UiRenderer.h"

#include <memory>
#include <optional>
#include <string>

namespace filament_core::view {

/// What lies over the viewer's picture.
enum class CompareMode : uint8_t { Off, Wipe, Difference, Flip };
const char* toString(CompareMode mode);
CompareMode nextMode(CompareMode mode);

enum class CompareWith : uint8_t { OtherApi, PathTracer };

class ComparedPictures {
public:
    CompareMode mode = CompareMode::Off;
    CompareWith with = CompareWith::OtherApi;
    std::string defect{};      ///< of defectsFor(), in the commands of the other API; empty: none
    float wipePosition = 0.5f; ///< of the width: the other API's picture is to the right

    /// Starts the other API, or the path tracer, if a mode wants it. `options` are those of the viewer's own engine.
    /// Whether there is news.
    bool follow(Document const& document, Stage& stage, SwapChain chain, uint2 offset, EngineOptions const& options);
    /// Whether the event moves the line of the wipe, which the pointer may drag.
    bool handle(InputEvent const& event, uint2 size);
    /// The map, the line of the wipe and the number.
    void draw(UiRenderer& ui, Engine& engine, uint2 offset, uint2 size);
    /// Before the engine of the viewer ends.
    void close(UiRenderer* ui);

    /// Of the newest pair of pictures that show the same document.
    std::optional<ImageComparison> const& result() const { return mResult; }
    /// Another picture, or a better one, is on its way.
    bool isWaiting() const {
        const bool isCurrent = mResult && mResultNumber == mNumber && mResultMode == mode && mIsFinal;
        return mode != CompareMode::Off && (!isCurrent || mComparing);
    }
    /// The other picture is drawn with `defect`.
    bool isDefective() const { return mOther && !mOpenedDefect.empty(); }
    /// What the picture is compared with: "gles: llvmpipe"; empty: nothing yet.
    std::string otherName() const { return mOther ? mOther->name() : std::string{}; }
    /// The path tracer's newest picture of the document; null: none.
    Image const* tracedPicture() const;
    std::vector<std::string> takeMessages() { return std::exchange(mMessages, {}); }

private:
    /// The window of the viewer, as it was read.
    struct OwnPicture {
        std::shared_ptr<const Image> window;
        uint2 offset{ 0 }, size{ 0 }; ///< of the picture
        uint64_t number = 0;          ///< of its document
    };
    struct Compared {
        std::optional<ImageComparison> result; ///< none: the window has changed its size meanwhile
        std::optional<Image> overlay;
    };
    bool openSource(EngineOptions const& options);
    void endOther();
    void readOwn(Stage& stage, SwapChain chain, uint2 offset);
    void compareNewest();
    bool takeCompared();
    static Compared compareAll(OwnPicture const& own, Image const& other, CompareMode mode);
    void upload(UiRenderer& ui, Engine& engine);
    void drawNumber(uint2 offset, uint2 size) const;
    void drawWipe(uint2 offset, uint2 size) const;

    std::unique_ptr<PictureSource> mOther;
    CompareWith mOpenedWith = CompareWith::OtherApi;
    std::string mOpenedDefect{};
    Document mDocument{};
    uint64_t mNumber = 0; ///< of the document
    PixelTicket mPending{};
    OwnPicture mPendingOwn; ///< without its window
    std::optional<OwnPicture> mOwn;
    std::optional<Background<Compared>> mComparing;
    uint64_t mComparingNumber = 0;
    uint32_t mComparingVersion = 0;
    bool mComparingIsFinal = false;
    CompareMode mComparingMode = CompareMode::Off;
    Abandoned mAbandoned;
    std::optional<ImageComparison> mResult;
    uint64_t mResultNumber = 0;
    uint32_t mResultVersion = 0;
    bool mIsFinal = false;
    CompareMode mResultMode = CompareMode::Off;
    std::optional<Image> mOverlay; ///< not uploaded yet
    Owned<Texture> mTexture;
    uint2 mTextureSize{ 0 };
    ImTextureID mTextureId{};
    float mPointer = 0; ///< pixels from the left
    bool mIsDragging = false;
    std::vector<std::string> mMessages;
};

} // namespace filament_core::view
