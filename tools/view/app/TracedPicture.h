// SPDX-License-Identifier: Apache-2.0
/// TracedPicture: the document as the path tracer sees it: the same camera, lights and exposure, all bounces, better
/// with every pass. Behind it the same tone mapper.
///   Shows    the file's own nodes, materials and lights, with the variant; the environment; lights that the document
///            adds. Edits of nodes, materials and the file's lights, animations, profiles of lights, the look and
///            post-processing and screen-space effects are not traced, except fog: reported once.
///   Thread   the main thread; rays are traced on one other thread of lower priority.
#pragma once

#include "tools/view/app/PictureSource.h"
#include "tools/view/compare/ProgressiveReference.h"

#include <memory>

namespace filament_core::view {

/// What the path tracer does not see of a document: one line; empty: nothing.
std::string untracedParts(Document const& document);

class TracedPicture final : public PictureSource {
public:
    explicit TracedPicture(uint32_t samplesPerPixel = 256) : mSamples(samplesPerPixel) {}

    void follow(Document const& document, uint64_t number) override;
    std::optional<NumberedPicture> const& picture() const override { return mPicture; }
    std::string name() const override;
    std::vector<std::string> takeMessages() override { return std::exchange(mMessages, {}); }

private:
    void restart(Document const& document, uint64_t number);
    void take();
    void noteFailure(TracingStatus const& status);

    uint32_t mSamples;
    ProgressiveReference mReference;
    std::optional<Document> mDocument;
    uint64_t mNumber = 0, mView = 0;
    std::optional<NumberedPicture> mPicture;
    std::string mLastFailure, mLastUntraced;
    std::vector<std::string> mMessages;
};

} // namespace filament_core::view
