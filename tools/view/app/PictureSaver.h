// SPDX-License-Identifier: Apache-2.0
/// PictureSaver: screenshots without panels, saved in the background: drawn into an image of
/// their own, read back over the next frames, encoded on another thread.
///   Use      save() or read(), then poll() once a step; close() before the engine ends: what has not been read is
///            lost.
///   Thread   the main thread.   Memory: the images on their way.
///   Life     the destructor waits for images that are being encoded.
///   Fails    lines of poll().
#pragma once

#include "tools/view/app/PictureFile.h"
#include "tools/view/stage/Background.h"
#include "tools/view/stage/Stage.h"

#include <deque>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace filament_core::view {

/// Which frame an image is.
enum class PictureFrame : uint8_t {
    Next, ///< the one that the stage would draw now: with what temporal effects have accumulated
    New,  ///< as a new stage would draw it
};

class PictureSaver {
public:
    void save(Stage& stage, std::filesystem::path file, PictureFormat format);
    /// `then` gets the image in a later poll().
    void read(Stage& stage, Format format, PictureFrame frame, std::function<void(Image)> then);
    /// Whether the file will be written by an image that is on its way.
    bool isWriting(std::filesystem::path const& file) const;
    bool isBusy() const { return !mPending.empty() || !mEncoding.empty(); }
    /// Continues with what has been read, and reports what was saved and what failed.
    std::vector<std::string> poll(Stage& stage);
    void close();

private:
    struct Pending {
        std::unique_ptr<Renderer> renderer; ///< none: that of the stage
        Owned<SwapChain> chain;
        PixelTicket ticket{};
        std::function<void(Image)> then;
    };
    struct Encoding {
        std::filesystem::path file;
        Background<std::string> line;
    };
    void encode(std::filesystem::path const& file, Image image, OutputSpace space);

    std::vector<std::filesystem::path> mFiles; ///< that are being drawn
    std::deque<Pending> mPending;
    std::deque<Encoding> mEncoding;
    std::vector<std::string> mMessages;
};

} // namespace filament_core::view
