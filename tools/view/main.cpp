// SPDX-License-Identifier: Apache-2.0
// filament-view [MODEL] [options]: shows a model or a material in a window.
// Exit status 0: the window was closed, or all files of the scene were loaded and the frames of --frames or --frames-to
// drawn, without an error.
#include "toolkit/program/Program.h"
#include "toolkit/program/SceneFiles.h"
#include "tools/view/app/RunViewer.h"

int main(int argc, char** argv) {
    using namespace filament_core;
    return tools::runProgram("filament-view", argc, argv, view::parseViewerOptions, view::runViewer,
                             "try a smaller model or size");
}
