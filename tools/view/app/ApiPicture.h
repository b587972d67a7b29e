// SPDX-License-Identifier: Apache-2.0
/// ApiPicture: the document on an engine of its own, without a window; with a defect in its commands, if one is asked
/// for.
///   Thread  the main thread.
///   Fails   create(): as Engine::create().
#pragma once

#include "tools/view/app/PictureSource.h"
#include "tools/view/stage/Stage.h"

#include <memory>
#include <string_view>

namespace filament_core::view {

/// Vulkan of OpenGL ES, and the reverse.
inline Backend otherThan(Backend backend) { return backend == Backend::Vulkan ? Backend::Gles : Backend::Vulkan; }

class ApiPicture final : public PictureSource {
public:
    /// `options`: of the viewer's engine; the display means nothing.
    /// `defect`: of defectsFor(); empty: none.
    static Result<std::unique_ptr<PictureSource>> create(Backend backend, EngineOptions const& options,
                                                         std::string_view defect = {});

    void follow(Document const& document, uint64_t number) override;
    std::optional<NumberedPicture> const& picture() const override { return mPicture; }
    std::string name() const override { return mName; }
    std::vector<std::string> takeMessages() override { return mStage->takeMessages(); }

private:
    explicit ApiPicture(std::unique_ptr<Stage> stage);
    void take();

    std::unique_ptr<Stage> mStage;
    Owned<SwapChain> mChain;
    uint2 mSize{ 0 };
    std::string mName;
    PixelTicket mPending{};
    uint64_t mPendingNumber = 0;
    bool mWasLoading = false;
    std::optional<NumberedPicture> mPicture;
};

} // namespace filament_core::view
