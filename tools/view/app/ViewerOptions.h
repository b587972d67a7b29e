// SPDX-License-Identifier: Apache-2.0
/// ViewerOptions: the checked command line of filament-view.
///   Fails   parseViewerOptions: InvalidArgument in one line that names the option, the value and what is valid.
#pragma once

#include "base/Result.h"
#include "toolkit/program/SceneOptions.h"
#include "tools/view/app/ComparedPictures.h"
#include "tools/view/app/PathFrames.h"

#include <filament_core/Backend.h>
#include <filament_core/NativeWindow.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::view {

struct ViewerOptions : tools::SceneOptions {
    Backend backend = Backend::Vulkan;
    PresentMode presentMode = PresentMode::Fifo;
    uint32_t frames = 0;              ///< ends after so many of the complete scene; 0: when the window is closed
    std::filesystem::path screenshot; ///< of the last frame, with the panels; .png; empty: none
    std::filesystem::path document;   ///< .json that a viewer wrote, in the place of the model and the other options
    std::filesystem::path cameraPath; ///< .json: a camera path, added to those of the document; empty: none
    FrameSeries series;               ///< of that path: drawn without a window, and the program ends; without a folder
                                      ///< and a video: a window opens
    bool drawsPath() const { return !series.folder.empty() || !series.video.empty(); }
    std::filesystem::path recentFiles; ///< RecentFiles.h; empty: none are kept
    bool panels = true;
    std::vector<std::string> openPanels;    ///< of panelNames(): each comes to the front of its column
    CompareMode compare = CompareMode::Off; ///< with the other API, from the start; the last frame waits for it
    std::string select;                     ///< a node of the model by its name; empty: none
    bool validation = false;
    int workers = -1; ///< as EngineOptions::workers
};

/// No value: the help text was requested and has been printed.
Result<std::optional<ViewerOptions>> parseViewerOptions(int argc, const char* const* argv);

} // namespace filament_core::view
