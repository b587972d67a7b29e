// SPDX-License-Identifier: Apache-2.0
/// PictureSource: draws the viewer's document in another way, beside the viewer: on the other API (ApiPicture.h), or by
/// the path tracer (TracedPicture.h). It follows the document, and never makes the viewer wait.
///   Use      once a frame: follow(document, number), then picture().
///   Pairs    images are compared only if both show the same document: each has the number of its document.
///   Thread   the main thread.
///   Fails    takeMessages(), one line each.
#pragma once

#include "tools/view/document/Document.h"

#include <filament_core/Image.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::view {

struct NumberedPicture {
    Image image{};
    uint64_t number = 0;  ///< of the document that it shows
    uint32_t version = 0; ///< grows while an image of one document becomes better
    bool isFinal = true;  ///< it will not
};

class PictureSource {
public:
    virtual ~PictureSource() = default;
    /// Draws the document, unless its image is there or on its way, and takes what has been finished.
    virtual void follow(Document const& document, uint64_t number) = 0;
    virtual std::optional<NumberedPicture> const& picture() const = 0;
    virtual std::string
    name() const = 0; ///< "gles: llvmpipe (LLVM 15.0.6, 256 bits)", "path tracer: 12 of 256 samples"
    virtual std::vector<std::string> takeMessages() = 0;
};

} // namespace filament_core::view
