// SPDX-License-Identifier: Apache-2.0
/// FrameSaver: saves frames of a document for filament-replay, on a thread of its own.
///   Out     a folder with the commands of both APIs (record/SavedFrame.h), the document, and the image as it was
///           shown.
///   Thread  the main thread; the engines that draw it again live on the other one.
///   Life    the destructor waits for a frame that is being saved.
#pragma once

#include "tools/view/document/Document.h"
#include "tools/view/stage/Background.h"

#include <filament_core/Image.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::view {

class FrameSaver {
public:
    /// `shown`: the image of the document without panels. False: one is being saved.
    bool start(std::filesystem::path folder, Document document, Image shown, int workers);
    bool isBusy() const { return mSaved.has_value(); }
    /// Once it is done: a line for each thing to know, the folder first.
    std::optional<std::vector<std::string>> poll() { return takeFinished(mSaved); }

private:
    std::optional<Background<std::vector<std::string>>> mSaved;
};

} // namespace filament_core::view
